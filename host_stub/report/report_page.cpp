#include "host_stub/report/report_page.h"

#include <cmath>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <stdexcept>

namespace seaglare::report {

namespace {

std::string escaped(const std::string& text) {
    std::string out;
    for (const char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else
            out += c;
    }
    return out;
}

// A gnuplot string in single quotes: only the quote itself is special, and doubled.
std::string quoted(const std::string& text) {
    std::string out = "'";
    for (const char c : text) {
        if (c == '\'') out += '\'';
        out += c;
    }
    return out + "'";
}

void write_file(const std::filesystem::path& path, const std::string& text) {
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    if (!file) throw std::runtime_error("cannot write " + path.string());
}

// Told apart by those who see fewer colours (Okabe & Ito 2008, "Color Universal Design"), and by dashes and symbols.
constexpr const char* line_types =
    "set for [i=1:8] linetype i lw 2 dt i ps 0.8\n"
    "set linetype 1 lc rgb '#0072B2' pt 7 dt 1\nset linetype 2 lc rgb '#D55E00' pt 5 dt (9,5)\n"
    "set linetype 3 lc rgb '#000000' pt 9 dt 1\nset linetype 4 lc rgb '#CC79A7' pt 13 dt (12,4,2,4)\n"
    "set linetype 5 lc rgb '#009E73' pt 11 dt (3,3)\nset linetype 6 lc rgb '#E69F00' pt 6 dt 1\n"
    "set linetype 7 lc rgb '#56B4E9' pt 4 dt (9,3)\nset linetype 8 lc rgb '#7F4F24' pt 8 dt (2,4)\n";

std::string script_of(const Plot& plot, const std::filesystem::path& folder) {
    std::string s = "cd " + quoted(std::filesystem::absolute(folder).string()) + "\n";
    s += "set datafile separator ','\nset datafile missing ''\nset key outside right top noenhanced\n";
    s += line_types;
    s += "set grid xtics ytics lt 1 lw 1 dt 1 lc rgb '#dddddd'\nset title " + quoted(plot.title) +
         " noenhanced\n";
    s += "set xlabel " + quoted(plot.x_label) + " noenhanced\nset ylabel " + quoted(plot.y_label) +
         " noenhanced\nset format y '%g'\n";
    if (plot.log_x) s += "set logscale x\n";
    if (plot.log_y) s += "set logscale y\nset format y '10^{%L}'\n";
    s += plot.extra + "\n";
    std::string curves = plot.command;
    for (const Curve& curve : plot.curves) {
        if (!curves.empty()) curves += ", ";
        const std::string columns = std::to_string(curve.x) + ":" + std::to_string(curve.y);
        curves += quoted(curve.csv) + " every ::1 using " + columns + " with " + curve.style + " title " +
                  quoted(curve.title);
        if (curve.labels > 0)
            curves += ", " + quoted(curve.csv) + " every ::1 using " + columns + ":" +
                      std::to_string(curve.labels) + " with labels " + curve.label_style +
                      " font ',8' noenhanced notitle";
    }
    const std::string size = " size " + std::to_string(plot.width) + "," + std::to_string(plot.height);
    for (const bool svg : {true, false}) {
        s += svg ? "set terminal svg" + size + " font 'sans,12' background 'white'"
                 : "set terminal pngcairo" + size + " font 'sans,10'";
        s.append("\nset output ").append(quoted(plot.name + (svg ? ".svg" : ".png")));
        s.append("\nplot ").append(curves).append("\n");
    }
    return s + "unset output\n";
}

}  // namespace

Table::Row& Table::Row::operator<<(double value) {
    char text[40] = "";
    if (std::isfinite(value)) std::snprintf(text, sizeof text, "%.6g", value);
    fields_.emplace_back(text);
    return *this;
}

Table::Row& Table::Row::operator<<(int value) {
    fields_.push_back(std::to_string(value));
    return *this;
}

Table::Row& Table::Row::operator<<(const std::string& text) {
    fields_.push_back(text);
    return *this;
}

Table::Row& Table::add() {
    flush();
    return rows_.emplace_back();
}

void Table::flush() const {
    if (!kept_at_.empty()) write_csv(kept_at_);
}

void Table::write_csv(const std::filesystem::path& path) const {
    std::string text;
    const auto line = [&text](const std::vector<std::string>& fields) {
        for (std::size_t i = 0; i < fields.size(); ++i) {
            if (i > 0) text += ',';
            if (fields[i].find_first_of(",\"\n") == std::string::npos) {
                text += fields[i];
                continue;
            }
            text += '"';
            for (const char c : fields[i])
                text += c == '"' ? std::string("\"\"") : std::string(1, c);
            text += '"';
        }
        text += "\n";
    };
    line(columns_);
    for (const Row& row : rows_)
        line(row.fields());
    write_file(path, text);
}

Page::Page(std::filesystem::path folder, std::string title)
    : folder_(std::move(folder)), title_(std::move(title)) {
    std::filesystem::create_directories(folder_);
}

void Page::heading(const std::string& text) {
    body_ += "<h2>" + escaped(text) + "</h2>\n";
}

void Page::paragraph(const std::string& text) {
    body_ += "<p>" + escaped(text) + "</p>\n";
}

void Page::pictures(const std::vector<std::string>& files, const std::vector<std::string>& captions) {
    body_ += "<div class=\"row\">\n";
    for (std::size_t i = 0; i < files.size(); ++i) {
        const std::string caption = i < captions.size() ? escaped(captions[i]) : "";
        const std::string file = escaped(files[i]);
        body_.append("<figure><a href=\"").append(file).append("\"><img src=\"").append(file);
        body_.append("\" alt=\"").append(caption).append("\"></a><figcaption>").append(caption);
        body_.append("</figcaption></figure>\n");
    }
    body_ += "</div>\n";
}

void Page::table(const std::string& name, const std::string& caption, const Table& table, bool shown) {
    table.write_csv(folder_ / (name + ".csv"));
    body_ += "<p>" + escaped(caption) + " (<a href=\"" + escaped(name) + ".csv\">" + escaped(name) +
             ".csv</a>)</p>\n";
    if (!shown) {
        write(false);
        return;
    }
    body_ += "<div class=\"wide\"><table><tr>";
    for (const std::string& column : table.columns())
        body_ += "<th>" + escaped(column) + "</th>";
    body_ += "</tr>\n";
    for (const Table::Row& row : table.rows()) {
        body_ += "<tr>";
        for (const std::string& field : row.fields())
            body_ += "<td>" + escaped(field) + "</td>";
        body_ += "</tr>\n";
    }
    body_ += "</table></div>\n";
    write(false);
}

bool Page::plot(const Plot& plot) {
    const std::string script = script_of(plot, folder_);
    write_file(folder_ / (plot.name + ".gp"), script);
    // Without gnuplot the shell ends at once and the pipe breaks: that must not end us.
    const auto handler = std::signal(SIGPIPE, SIG_IGN);
    int status = -1;
    // The command is a constant; what varies goes through the pipe.
    if (std::FILE* const pipe = popen("gnuplot", "w")) {  // NOLINT(cert-env33-c)
        std::fputs(script.c_str(), pipe);
        status = pclose(pipe);
    }
    std::signal(SIGPIPE, handler);
    if (status != 0) {
        body_ += "<p class=\"missing\">" + escaped(plot.title) +
                 ": not drawn, because gnuplot could not be run; its script is <a href=\"" +
                 escaped(plot.name) + ".gp\">" + escaped(plot.name) + ".gp</a>.</p>\n";
        return false;
    }
    body_ += "<figure><a href=\"" + escaped(plot.name) + ".png\"><img class=\"plot\" src=\"" +
             escaped(plot.name) + ".svg\" alt=\"" + escaped(plot.title) + "\"></a></figure>\n";
    return true;
}

void Page::write(bool whole) const {
    const std::string remark =
        whole ? ""
              : "<p class=\"missing\">Not all of it: the report is being made, or was interrupted.</p>\n";
    write_file(
        folder_ / "index.html",
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n<title>" + escaped(title_) +
            "</title>\n<style>\nbody{font:15px/1.45 sans-serif;max-width:70rem;margin:2rem auto;padding:0 "
            "1rem;"
            "color:#222}\nh1,h2{line-height:1.2}\n.row{display:flex;flex-wrap:wrap;gap:1rem}\nfigure{margin:"
            "0 0 "
            "1rem}\nimg{max-width:100%;image-rendering:pixelated}\nimg.plot{image-rendering:auto}\n.row "
            "img{width:16rem}\n.row "
            "img.plot{width:33rem}\nfigcaption{font-size:.85em;color:#555;max-width:16rem}\n.wide{overflow-x:"
            "auto}"
            "\n"
            "table{border-collapse:collapse;font-size:.85em;margin:.5rem 0 1rem}\nth,td{border:1px solid "
            "#ccc;padding:.2rem .5rem;text-align:right}\nth:first-child,td:first-child{text-align:left}\nth{"
            "background:#f3f3f3}\n.missing{color:#a00}\n</style></head><body>\n<h1>" +
            escaped(title_) + "</h1>\n" + remark + body_ + "</body></html>\n");
}

}  // namespace seaglare::report
