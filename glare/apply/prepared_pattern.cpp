#include "glare/apply/prepared_pattern.h"

#include <algorithm>
#include <utility>

namespace seaglare::glare {

namespace {

PreparedPattern::Copies& add_to(PreparedPattern& prepared, const std::shared_ptr<ClShared>& context) {
    PreparedPattern::Copies& made =
        *prepared.copies.emplace_back(std::make_unique<PreparedPattern::Copies>());
    made.context = context;
    return made;
}

}  // namespace

void PatternUses::add(const PatternUse& use) {
    draws = draws || use.draws;
    grids = grids || use.grids;
    if (!use.gather) return;
    for (std::shared_ptr<ClShared>& known : gather) {
        if (known == use.gather) return;
        if (known) continue;
        known = use.gather;
        return;
    }
}

const PatternTexels* PreparedPattern::texels_of(const Pattern& pattern) const {
    return pattern.generation != 0 && texels.generation == pattern.generation ? &texels : nullptr;
}

const GridTexels* PreparedPattern::grid_texels_of(const Pattern& pattern) const {
    return pattern.generation != 0 && grid_texels.generation == pattern.generation ? &grid_texels : nullptr;
}

const GatherPattern* PreparedPattern::copies_of(const Pattern& pattern, const ClShared& context) const {
    if (pattern.generation == 0) return nullptr;
    for (const auto& made : copies)
        if (made->context.get() == &context && made->pattern.generation == pattern.generation)
            return &made->pattern;
    return nullptr;
}

std::size_t PreparedPattern::device_bytes() const {
    std::size_t total = 0;
    for (const auto& made : copies)
        total += made->pattern.bytes();
    return total;
}

PatternPreparer::Context& PatternPreparer::context_of(const std::shared_ptr<ClShared>& shared) {
    for (const auto& context : contexts_)
        if (context->device.shared() == shared) return *context;
    return *contexts_.emplace_back(std::make_unique<Context>(shared));
}

void PatternPreparer::prepare(const Pattern& pattern, const PatternUses& uses, PreparedPattern& to) {
    const auto wanted = [&](const std::shared_ptr<ClShared>& context) {
        return std::find(uses.gather.begin(), uses.gather.end(), context) != uses.gather.end();
    };
    std::erase_if(to.copies, [&](const auto& made) { return !wanted(made->context); });
    if (!uses.draws)
        to.texels = {};
    else if (to.texels_of(pattern) == nullptr)
        make_texels(pattern, to.texels);
    if (uses.grids)
        grid_texels_.make(pattern, to.grid_texels);
    else
        to.grid_texels = {};
    for (const std::shared_ptr<ClShared>& context : uses.gather) {
        if (!context || to.copies_of(pattern, *context) != nullptr) continue;
        const auto there = std::find_if(to.copies.begin(), to.copies.end(),
                                        [&](const auto& made) { return made->context == context; });
        try {
            GatherPatternWriter& writer = context_of(context).writer;
            PreparedPattern::Copies& made = there != to.copies.end() ? **there : add_to(to, context);
            writer.write(pattern, made.pattern);
        } catch (const ClError&) {
            continue;
        }
    }
}

}  // namespace seaglare::glare
