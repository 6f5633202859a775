// Inside of colreg.h: the lights of one vessel, paragraph by paragraph. What all vessels share and Rules 23 to 25 are in
// colreg.cpp, Rules 26, 27 and 29 in colreg_special.cpp.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include "lightdb/colreg_lamps.h"
#include "lightdb/colreg_placement.h"

namespace seaglare::lightdb {

const char* colreg_colour_word(Colour colour);  // "red", "green", "yellow", else "white"

// Collects the lights of one vessel, each function those of one paragraph.
class ColregRules {
  public:
    explicit ColregRules(const Vessel& vessel);  // keeps a reference

    std::vector<Light> all();

  private:
    Light& add(const std::string& name, Colour colour, double range_nm, const LampPlace& at,
               const std::string& rule) {
        return lights_.emplace_back(colreg_lamp(vessel_, name, colour, range_nm, at, rule));
    }
    void all_round(const std::string& name, Colour colour, const LampPlace& at, const std::string& rule) {
        add(name, colour, ranges_.all_round_nm, at, rule);
    }
    void masthead(const std::string& name, const LampPlace& at, const std::string& rule) {
        add(name, Colour::white, ranges_.masthead_nm, at, rule).sectors = masthead_arc();
    }

    void mastheads(const std::string& rule);
    void towing_mastheads(int lights, const std::string& rule);
    void sidelights(const std::string& rule) { sidelights(place_.side_y_m, place_.side_z_m, rule); }
    void sidelights(double y_m, double z_m, const std::string& rule);
    void sternlight(const std::string& rule);
    // All-round lights in a vertical line, from the highest down.
    void line(std::initializer_list<Colour> colours, const std::string& rule) {
        line(colours, {0, place_.main_y_m, place_.line_top_m}, ranges_.all_round_nm, "", rule);
    }
    void line(std::initializer_list<Colour> colours, const LampPlace& top, double range_nm,
              const std::string& what, const std::string& rule);
    void anchor_lights(const std::string& rule);
    void deck_lights(const std::string& rule);

    void power_driven();
    void towing();
    void towed_submerged();
    void sailing();
    void trawling();
    void fishing();
    void trawl_signal();
    void purse_seine_signal(double top_z_m);
    void restricted();
    void obstruction();
    void mine_clearance();
    void pilot();

    const Vessel& vessel_;
    const ColregRanges ranges_;
    const Placement place_;
    std::vector<Light> lights_;
};

}  // namespace seaglare::lightdb
