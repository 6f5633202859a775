// What a report is made of: tables (CSV), plots that gnuplot draws from them (SVG and PNG), pictures, and one page that
// shows all of it and opens without a server.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace seaglare::report {

// A table of text and numbers. Numbers are written with six digits; NaN as an empty field.
class Table {
  public:
    explicit Table(std::vector<std::string> columns) : columns_(std::move(columns)) {}
    class Row {
      public:
        Row& operator<<(double value);
        Row& operator<<(int value);
        Row& operator<<(const std::string& text);
        Row& operator<<(const char* text) { return *this << std::string(text); }
        const std::vector<std::string>& fields() const { return fields_; }

      private:
        std::vector<std::string> fields_;
    };
    // Also writes the rows there are to the kept file, so that who interrupts a long report has them.
    Row& add();
    // From now on add() and flush() write the table there. Throws as write_csv().
    void keep_at(std::filesystem::path path) { kept_at_ = std::move(path); }
    void flush() const;
    const std::vector<std::string>& columns() const { return columns_; }
    const std::vector<Row>& rows() const { return rows_; }
    // RFC 4180, with a header line. Throws std::runtime_error that names the path.
    void write_csv(const std::filesystem::path& path) const;

  private:
    std::vector<std::string> columns_;
    std::vector<Row> rows_;
    std::filesystem::path kept_at_;  // empty: nowhere
};

// One curve of a plot: columns of a CSV in the page's folder, counted from 1.
struct Curve {
    std::string csv;
    int x = 1;
    int y = 2;
    std::string title;
    std::string style = "lines";  // as gnuplot has it
    int labels = 0;               // column whose text stands beside each point; 0: none
    std::string label_style = "left offset 0.7,0.4";
};

struct Plot {
    std::string name;  // of the files: NAME.svg, NAME.png
    std::string title;
    std::string x_label;
    std::string y_label;
    std::vector<Curve> curves;
    bool log_x = false;
    bool log_y = false;
    std::string extra;         // more gnuplot commands
    std::string command = {};  // what to plot before the curves, or in their place, as gnuplot has it
    int width = 900;
    int height = 520;
};

// A page, its tables and its plots are written as they come; finish() takes the remark away that it is not whole.
class Page {
  public:
    // Creates the folder. Throws std::filesystem::filesystem_error.
    Page(std::filesystem::path folder, std::string title);

    const std::filesystem::path& folder() const { return folder_; }
    void heading(const std::string& text);
    void paragraph(const std::string& text);
    // Pictures in a row; `files` are in the page's folder.
    void pictures(const std::vector<std::string>& files, const std::vector<std::string>& captions);
    // Has the table's rows written to NAME.csv as they are added; table() shows it.
    void keep(const std::string& name, Table& table) const { table.keep_at(folder_ / (name + ".csv")); }
    // Writes NAME.csv and shows it; `shown` false: a link only.
    void table(const std::string& name, const std::string& caption, const Table& table, bool shown = true);
    // False when gnuplot is not there: the page says so and shows the numbers' place.
    bool plot(const Plot& plot);
    // Writes index.html.
    void finish() const { write(true); }

  private:
    void write(bool whole) const;
    std::filesystem::path folder_;
    std::string title_;
    std::string body_;
};

}  // namespace seaglare::report
