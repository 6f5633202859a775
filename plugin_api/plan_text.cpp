#include "plugin_api/plan_text.h"

#include "lightdb/json/writer.h"

namespace seaglare::plugin {

namespace {

// What a lamp without its own pattern is off by, at most, as measured there: glare/colour/README.md.
constexpr double filter_error_codes = 58;
constexpr double stand_in_error_codes = 58;

void pass(json::Writer& writer, const char* name, const std::string& reason, double milliseconds) {
    writer.begin_object(json::Writer::Layout::line);
    writer.member("pass", name);
    writer.member("reason", reason);
    writer.member("cpu_ms", milliseconds);
    writer.end_object();
}

void left_out(json::Writer& writer, const char* what, const std::string& reason, double count,
              double error_bound_codes) {
    if (count == 0) return;
    writer.begin_object(json::Writer::Layout::line);
    writer.member("what", what);
    writer.member("reason", reason);
    writer.member("count", count);
    writer.member("error_bound_codes", error_bound_codes);
    writer.end_object();
}

}  // namespace

std::string plan_text(const PlanFacts& facts, const seaglare_stats& stats) {
    json::Writer writer;
    writer.begin_object();
    writer.member("channel", facts.channel);
    writer.member("pattern_device", facts.device);
    writer.member("degraded", !facts.degraded_reason.empty());
    if (!facts.degraded_reason.empty()) writer.member("degraded_reason", facts.degraded_reason);
    writer.member("drawn", facts.drawn);

    writer.key("passes");
    writer.begin_array();
    if (facts.rendered) {
        pass(writer, "evaluate", std::to_string(stats.lights_total) + " lights in the database",
             stats.evaluate_ms);
        if (facts.asked_visibility) pass(writer, "visibility", "the frame has a visibility callback", 0);
    }
    if (facts.drawn) {
        pass(writer, "pattern",
             facts.pattern_reused ? "reused: already made for this instant and pitch"
                                  : "the eye moves: a new instant",
             stats.pattern_ms);
        pass(writer, "upload", std::to_string(stats.lights_drawn) + " lights can change a display code",
             stats.upload_ms);
        pass(writer, "accumulate", "one billboard a light", stats.accumulate_ms);
        pass(writer, "composite", "tone map and add to the target", stats.composite_ms);
    }
    writer.end_array();

    writer.key("left_out");
    writer.begin_array();
    left_out(writer, "light", "dark: off, eclipsed, outside its sectors or profile", stats.lights_dark, 0);
    left_out(writer, "light", "below the geographical horizon", stats.lights_horizon, 0);
    left_out(writer, "light", "behind the eye, or its glare does not reach into the picture",
             stats.lights_outside, facts.threshold_codes);
    left_out(writer, "light", "too far: at its brightest it would change no display code", facts.too_far,
             facts.threshold_codes);
    left_out(writer, "light", "changes no display code", stats.lights_below_threshold - facts.too_far,
             facts.threshold_codes);
    left_out(writer, "light", "hidden: the visibility callback says 0", facts.hidden_by_host, 0);
    if (facts.rendered && !facts.drawn)
        left_out(writer, "frame", "no light is visible: no GL call is made", 1, 0);
    if (facts.drawn) {
        // The bounds: glare/colour/README.md.
        left_out(writer, "lamp's own pattern",
                 facts.filtered
                     ? "spectra is \"filter\": the white pattern, tinted"
                     : "more lamps in view than max_lamps_in_view: the pattern of the nearest lamp",
                 facts.with_pattern_of_another, facts.filtered ? filter_error_codes : stand_in_error_codes);
        left_out(writer, "lamp's own pattern",
                 "more than 25 named spectra in the database: the pattern of the nearest lamp",
                 facts.spectra_without_pattern, stand_in_error_codes);
    }
    if (facts.drawn && facts.layers_configured > stats.pattern_layers) {
        left_out(writer, "disc layer", "no light in view is that large",
                 facts.layers_configured - stats.pattern_layers, 0);
    }
    writer.end_array();
    writer.end_object();
    return writer.take();
}

}  // namespace seaglare::plugin
