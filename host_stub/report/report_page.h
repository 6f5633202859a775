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
    Row& add() { return rows_.emplace_back(); }
    const std::vector<std::string>& columns() const { return columns_; }
    const std::vector<Row>& rows() const { return rows_; }
    // RFC 4180, with a header line. Throws std::runtime_error that names the path.
    void write_csv(const std::filesystem::path& path) const;

  private:
    std::vector<std::string> columns_;
    std::vector<Row> rows_;
};

// One curve of a plot: columns of a CSV in the page's folder, counted from 1.
struct Curve {
    std::string csv;
    int x = 1;
    int y = 2;
    std::string title;
    std::string style = "lines";  // as gnuplot has it
    int labels = 0;               // column whose text stands beside each point; 0: none
};

struct Plot {
    std::string name;  // of the files: NAME.svg, NAME.png
    std::string title;
    std::string x_label;
    std::string y_label;
    std::vector<Curve> curves;
    bool log_x = false;
    bool log_y = false;
    std::string extra;  // more gnuplot commands
};

// A page is written in one go by finish(); tables and plots are written as they come.
class Page {
  public:
    // Creates the folder. Throws std::filesystem::filesystem_error.
    Page(std::filesystem::path folder, std::string title);

    const std::filesystem::path& folder() const { return folder_; }
    void heading(const std::string& text);
    void paragraph(const std::string& text);
    // Pictures in a row; `files` are in the page's folder.
    void pictures(const std::vector<std::string>& files, const std::vector<std::string>& captions);
    // Writes NAME.csv and shows it; `shown` false: a link only.
    void table(const std::string& name, const std::string& caption, const Table& table, bool shown = true);
    // False when gnuplot is not there: the page says so and shows the numbers' place.
    bool plot(const Plot& plot);
    // Writes index.html.
    void finish() const;

  private:
    std::filesystem::path folder_;
    std::string title_;
    std::string body_;
};

}  // namespace seaglare::report
