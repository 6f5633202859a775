#include "glare/plan/quality_savings.h"

#include <algorithm>

namespace seaglare::glare {

double counted_ms(const Plan& plan) {
    double ms = plan.predicted_ms;
    for (const PlannedPass& pass : plan.passes.all())
        if (pass.kind == PassKind::pattern) ms -= (1 - pattern_beside_part) * pass.predicted_ms;
    return ms;
}

Saving saving_of(Quality kind, const PlanInput& input, const Budget& budget, const DeviceCosts& costs) {
    PlanInput asked = input;
    asked.given_up.of(kind) = 0;
    const Plan with = make_plan(asked, budget, costs);
    asked.given_up.of(kind) = 1;
    const Plan without = make_plan(asked, budget, costs);
    const double before_ms = counted_ms(with);
    Saving saving;
    saving.ms = std::max(before_ms - counted_ms(without), 0.0);
    saving.part = before_ms > 0 ? saving.ms / before_ms : 0;
    saving.codes = std::max(without.error_bound_codes - with.error_bound_codes, 0.0);
    return saving;
}

}  // namespace seaglare::glare
