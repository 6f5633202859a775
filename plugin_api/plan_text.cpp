#include "plugin_api/plan_text.h"

#include <string_view>

#include "lightdb/json/writer.h"

namespace seaglare::plugin {

namespace {

using Layout = json::Writer::Layout;

// CPU and GPU times of a pass; a pass without a time of its own has none.
struct Taken {
    double cpu_ms = -1;
    double gpu_ms = -1;
};

Taken taken_by(glare::PassKind kind, const seaglare_stats& stats) {
    const bool gpu = stats.gpu_frames_ago > 0;
    switch (kind) {
        case glare::PassKind::evaluate:
            return {stats.evaluate_ms, -1};
        case glare::PassKind::visibility:
            return {};
        case glare::PassKind::pattern:
            return {stats.pattern_ms, -1};
        case glare::PassKind::upload:
            return {stats.upload_ms, gpu ? stats.gpu_upload_ms : -1};
        case glare::PassKind::occlusion:
            return {stats.occlusion_ms, gpu ? stats.gpu_occlusion_ms : -1};
        case glare::PassKind::accumulate:
            return {stats.accumulate_ms, gpu ? stats.gpu_accumulate_ms : -1};
        case glare::PassKind::composite:
            return {stats.composite_ms, gpu ? stats.gpu_composite_ms : -1};
    }
    return {};
}

void write_budget(json::Writer& writer, const glare::Plan& plan, const seaglare_stats& stats) {
    writer.key("budget");
    writer.begin_object(Layout::line);
    writer.member("max_error_codes", plan.max_error_codes);
    writer.member("error_bound_codes", plan.error_bound_codes);
    writer.member("time_ms", stats.time_budget_ms);
    writer.member("taken_ms", stats.taken_ms);
    writer.member("predicted_ms", stats.predicted_ms);
    writer.member("quality_loss", plan.given_up.mean());
    writer.end_object();
    if (!(stats.time_budget_ms > 0)) return;
    writer.key("given_up");
    writer.begin_object();
    for (std::size_t k = 0; k < glare::quality_kinds; ++k)
        writer.member(std::string(name_of(static_cast<glare::Quality>(k))), plan.given_up.level[k]);
    writer.member("saved_ms", stats.saved_ms);
    writer.member("could_save_ms", stats.could_save_ms);
    writer.end_object();
    if (stats.limiting_pass == SEAGLARE_PASS_NONE) return;
    const auto pass = static_cast<glare::PassKind>(stats.limiting_pass - 1);
    writer.member("time_budget_cannot_be_kept_for", std::string(name_of(pass)));
}

void write_choices(json::Writer& writer, const PlanFacts& facts, const glare::Plan& plan) {
    writer.key("choices");
    writer.begin_object();
    const glare::AccumulationPlan& how = plan.accumulation;
    writer.member("accumulation", std::string(name_of(how.method)));
    writer.member("skirt_threshold_cd_m2", how.skirt_threshold_cd_m2);
    writer.member("tail_threshold_cd_m2", how.tail_threshold_cd_m2);
    writer.member("tail_cell_px", static_cast<double>(how.tail_cell_px));
    writer.member("disc_scale", how.disc_scale);
    writer.member("largest_disc_nodes", plan.largest_disc_nodes);
    writer.member("pattern", std::string(name_of(plan.pattern)));
    writer.member("pattern_reused", facts.pattern_reused);
    writer.member("pattern_step_s", plan.pattern_step_s);
    writer.member("rod_hue", plan.rod_hue);
    writer.member("filter_blend", plan.filter_blend);
    writer.end_object();
}

void write_passes(json::Writer& writer, const PlanFacts& facts, const glare::Plan& plan,
                  const seaglare_stats& stats) {
    writer.key("passes");
    writer.begin_array();
    for (const glare::PlannedPass& pass : plan.passes.all()) {
        if (!facts.drawn && pass.kind != glare::PassKind::evaluate &&
            pass.kind != glare::PassKind::visibility)
            continue;
        writer.begin_object(Layout::line);
        writer.member("pass", std::string(name_of(pass.kind)));
        writer.member("reason", std::string(pass.reason));
        writer.member("predicted_ms", pass.predicted_ms);
        const Taken taken = taken_by(pass.kind, stats);
        if (taken.cpu_ms >= 0) writer.member("cpu_ms", taken.cpu_ms);
        if (taken.gpu_ms >= 0) writer.member("gpu_ms", taken.gpu_ms);
        writer.end_object();
    }
    writer.end_array();
}

void write_left_out(json::Writer& writer, const PlanFacts& facts, const glare::Plan& plan) {
    writer.key("left_out");
    writer.begin_array();
    for (const glare::Omission& omission : plan.left_out.all()) {
        writer.begin_object(Layout::line);
        writer.member("what", std::string(name_of(omission.what)));
        writer.member("reason", std::string(omission.reason));
        writer.member("count", omission.count);
        writer.member("error_bound_codes", omission.bound_codes);
        writer.end_object();
    }
    if (facts.late_lights > 0) {
        writer.begin_object(Layout::line);
        writer.member("what", std::string("late skirts"));
        writer.member("reason", std::string("it is not known yet how much of the light is hidden: its glare "
                                            "comes with the next frames"));
        writer.member("count", static_cast<double>(facts.late_lights));
        writer.member("error_bound_codes", 255.0);
        writer.end_object();
    }
    writer.end_array();
}

void write_costs(json::Writer& writer, const char* key, const glare::DeviceCosts& costs) {
    writer.key(key);
    writer.begin_object();
    writer.member("pinned", costs.pinned);
    for (std::size_t i = 0; i < glare::work_kinds; ++i) {
        const auto work = static_cast<glare::Work>(i);
        writer.member(std::string(name_of(work)), costs.of(work));
    }
    writer.end_object();
}

void write_memory(json::Writer& writer, const glare::DeviceMemory& memory) {
    writer.key("device_memory_bytes");
    writer.begin_object();
    writer.member("hdr", memory.hdr);
    writer.member("coarse_grid", memory.coarse_grid);
    writer.member("background", memory.background);
    writer.member("occlusion", memory.occlusion);
    writer.member("lights", memory.lights);
    writer.member("pattern_layers", memory.pattern_layers);
    writer.member("accumulation", memory.accumulation);
    writer.member("pattern_core", memory.pattern_core);
    writer.member("pattern_wide_field", memory.pattern_wide_field);
    writer.member("pattern_screen", memory.pattern_screen);
    writer.member("total", memory.total());
    writer.end_object();
}

}  // namespace

std::string plan_text(const PlanFacts& facts, const glare::Plan& plan, const glare::DeviceCosts& costs,
                      const glare::DeviceCosts& measured, const seaglare_stats& stats) {
    json::Writer writer;
    writer.begin_object();
    writer.member("channel", facts.channel);
    writer.member("pattern_device", facts.device);
    writer.member("opencl_to_gl", facts.sharing);
    writer.member("degraded", !facts.degraded_reason.empty());
    if (!facts.degraded_reason.empty()) writer.member("degraded_reason", facts.degraded_reason);
    writer.member("drawn", facts.drawn);
    write_budget(writer, plan, stats);
    if (plan.draw) write_choices(writer, facts, plan);
    write_passes(writer, facts, plan, stats);
    write_left_out(writer, facts, plan);
    write_costs(writer, "device_costs_ns", costs);
    write_costs(writer, "measured_costs_ns", measured);
    write_memory(writer, facts.memory);
    writer.end_object();
    return writer.take();
}

}  // namespace seaglare::plugin
