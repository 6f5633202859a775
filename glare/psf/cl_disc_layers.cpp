#include "glare/psf/cl_disc_layers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <stdexcept>

namespace seaglare::glare {

namespace {

constexpr std::size_t strip_group = 4;
constexpr std::size_t nodes_per_item = 16;  // average_disc
constexpr int most_reach = 16;              // average_rows
constexpr int nodes_per_piece = 128;
constexpr std::size_t node_floats = 4;
constexpr std::size_t node_bytes = node_floats * sizeof(float);

using Span = std::array<std::int32_t, 2>;
using Tap = std::array<std::int32_t, 4>;
using Step = std::array<std::int32_t, 2>;

std::int32_t bits_of(double value) {
    return std::bit_cast<std::int32_t>(static_cast<float>(value));
}
std::size_t nodes_of_layer(const PatternGrid& grid) {
    return static_cast<std::size_t>(grid.radius + 1) * static_cast<std::size_t>(grid.side());
}
std::size_t groups_of(int count, int size) {
    return static_cast<std::size_t>((count + size - 1) / size);
}

// What average_rows adds to a column of the disc to make the next one nearer to its middle.
struct ColumnSteps {
    int reach = -1;
    std::vector<std::int32_t> first_of;
    std::vector<Step> steps;
};
ColumnSteps column_steps(const DiscStencil& disc) {
    std::array<std::array<double, most_reach + 2>, most_reach + 2> weight{};
    ColumnSteps result;
    int reach = 0;
    const auto put = [&](int column, int row, double value) {
        column = std::abs(column);
        row = std::abs(row);
        reach = std::max({reach, column, row});
        if (reach <= most_reach)
            weight[static_cast<std::size_t>(column)][static_cast<std::size_t>(row)] = value;
    };
    for (const DiscSpan& span : disc.spans)
        for (int k = -span.half_width; k <= span.half_width; ++k)
            put(span.dy, k, disc.span_weight);
    for (const DiscTap& tap : disc.taps)
        put(tap.dy, tap.dx, tap.weight);
    if (reach > most_reach) return result;
    result.reach = reach;
    for (auto column = static_cast<std::size_t>(reach) + 1; column-- > 0;) {
        result.first_of.push_back(static_cast<std::int32_t>(result.steps.size()));
        for (std::size_t row = 0; row <= static_cast<std::size_t>(reach); ++row) {
            const double more = weight[column][row] - weight[column + 1][row];
            if (more != 0) result.steps.push_back({static_cast<std::int32_t>(row), bits_of(more)});
        }
    }
    result.first_of.push_back(static_cast<std::int32_t>(result.steps.size()));
    return result;
}

template <typename Entry>
void upload(const ClDevice& device, ClBuffer& buffer, std::vector<Entry>& entries, const char* what) {
    if (entries.empty()) entries.push_back({});  // no buffer is empty
    const std::size_t bytes = entries.size() * sizeof(Entry);
    buffer.reserve(device.context(), device.queue(), bytes, what);
    buffer.write(device.queue(), bytes, entries.data());
}

// Rows -radius ... -1 of a layer are rows radius ... 1 back to front.
void mirror_rows(const PatternGrid& grid, float* layer) {
    using Node = std::array<float, node_floats>;
    auto* const nodes = reinterpret_cast<Node*>(layer);
    const auto half = static_cast<std::ptrdiff_t>(grid.radius) * grid.side();
    Node* const end = nodes + half + grid.side() + half;
    std::reverse_copy(nodes + half + grid.side(), end, nodes);
}

}  // namespace

SkirtLayout::SkirtLayout(const PatternGrid& grid)
    : border(grid.radius + grid.margin),
      columns(static_cast<std::size_t>(((border + 11) / 4 * 4 + border + 20) / 4 * 4)),
      rows(static_cast<std::size_t>(border) + static_cast<std::size_t>(grid.margin) + 1) {}

ClDiscLayers::ClDiscLayers(const ClDevice& device, cl_program program, const std::vector<float>& radii_nodes)
    : device_(device),
      sum_skirt_(program, "sum_skirt"),
      average_disc_(program, "average_disc"),
      average_rows_(program, "average_rows"),
      in_rows_(device.is_cpu()) {
    std::vector<Span> spans;
    std::vector<Tap> taps;
    std::vector<Step> steps;
    std::vector<float> radii = {0.0F};
    radii.insert(radii.end(), radii_nodes.begin(), radii_nodes.end());
    for (float radius : radii) {
        const DiscStencil disc = make_disc_stencil(static_cast<double>(radius));
        Stencil s;
        s.radius = radius;
        s.span_begin = static_cast<cl_int>(spans.size());
        s.tap_begin = static_cast<cl_int>(taps.size());
        s.span_weight = static_cast<cl_float>(disc.span_weight);
        // Transposed, and still a disc: pattern.cl sums the skirt by columns.
        for (const DiscSpan& span : disc.spans)
            spans.push_back({span.dy, span.half_width});
        for (const DiscTap& tap : disc.taps)
            taps.push_back({tap.dy, tap.dx, bits_of(tap.weight), 0});
        s.span_end = static_cast<cl_int>(spans.size());
        s.tap_end = static_cast<cl_int>(taps.size());
        ColumnSteps columns = column_steps(disc);
        s.reach = columns.reach;
        for (std::int32_t& first : columns.first_of)
            first += static_cast<std::int32_t>(steps.size());
        steps.insert(steps.end(), columns.steps.begin(), columns.steps.end());
        upload(device, s.first_of, columns.first_of, "columns of discs");
        device.finish();  // the vector ends here
        stencils_.push_back(std::move(s));
    }
    upload(device, spans_, spans, "spans of discs");
    upload(device, taps_, taps, "rims of discs");
    upload(device, steps_, steps, "steps between columns of discs");
    device.finish();
}

const ClDiscLayers::Stencil& ClDiscLayers::stencil(float radius) const {
    const auto found = std::find_if(stencils_.begin(), stencils_.end(),
                                    [radius](const Stencil& s) { return s.radius == radius; });
    if (found == stencils_.end())
        throw std::logic_error("glare pattern: a layer that the settings do not name");
    return *found;
}

void ClDiscLayers::reserve(const PatternGrid& grid, std::size_t layers) {
    layers_.reserve(device_.context(), device_.queue(), layers * nodes_of_layer(grid) * node_bytes,
                    "disc layers");
}

void ClDiscLayers::average_any(const PatternGrid& grid, const Stencil& s, cl_mem skirt, cl_mem balance,
                               cl_int at) {
    average_disc_.set(skirt, beyond_.get(), SkirtLayout(grid).border, grid.margin, grid.radius, spans_.get(),
                      s.span_begin, s.span_end, s.span_weight, taps_.get(), s.tap_begin, s.tap_end, balance,
                      layers_.get(), at);
    average_disc_.launch(device_.queue(), groups_of(grid.side(), static_cast<int>(nodes_per_item)),
                         static_cast<std::size_t>(grid.radius) + 1, 4, 2);
}

void ClDiscLayers::average_rows(const PatternGrid& grid, const Stencil& s, cl_mem skirt, cl_mem balance,
                                cl_int at) {
    const float lit_radius = static_cast<float>(grid.structure_radius) + s.radius + 1;
    average_rows_.set(skirt, SkirtLayout(grid).border, grid.margin, grid.radius, lit_radius, s.reach,
                      s.first_of.get(), steps_.get(), balance, layers_.get(), at);
    average_rows_.launch(device_.queue(), groups_of(grid.side() + 3, nodes_per_piece),
                         static_cast<std::size_t>(grid.radius) + 1, 1, 4);
}

int ClDiscLayers::average(const PatternGrid& grid, const std::vector<float>& radii_nodes, cl_mem skirt,
                          cl_mem balance) {
    cl_command_queue queue = device_.queue();
    const auto by_rows = [&](const Stencil& s) { return in_rows_ && s.reach >= 0; };
    int launches = 0;
    bool summed = false;
    for (std::size_t l = 0; l < radii_nodes.size(); ++l) {
        const Stencil& s = stencil(radii_nodes[l]);
        const auto at = static_cast<cl_int>(l * nodes_of_layer(grid));
        ++launches;
        if (by_rows(s)) {
            average_rows(grid, s, skirt, balance, at);
            continue;
        }
        if (!summed) {
            const SkirtLayout layout(grid);
            beyond_.reserve(device_.context(), queue, layout.bytes() + layout.columns * node_bytes,
                            "sums of the skirt");
            sum_skirt_.set(skirt, layout.border, grid.margin, beyond_.get());
            sum_skirt_.launch(queue, layout.columns / 4, strip_group);
            summed = true;
            ++launches;
        }
        average_any(grid, s, skirt, balance, at);
    }
    return launches;
}

void ClDiscLayers::read(const PatternGrid& grid, std::size_t layers, float* nodes) const {
    const std::size_t floats = nodes_of_layer(grid) * node_floats;
    const auto side = static_cast<std::size_t>(grid.side());
    const std::size_t layer_floats = side * side * node_floats;
    for (std::size_t l = 0; l < layers; ++l) {
        float* const layer = nodes + l * layer_floats;
        // Blocking: a read under way must not outlive the memory it writes to when a later call fails.
        check_cl(
            clEnqueueReadBuffer(device_.queue(), layers_.get(), CL_TRUE, l * floats * sizeof(float),
                                floats * sizeof(float), layer + layer_floats - floats, 0, nullptr, nullptr),
            "clEnqueueReadBuffer(disc layers)");
        mirror_rows(grid, layer);
    }
}

std::size_t ClDiscLayers::device_bytes() const {
    std::size_t total = spans_.bytes() + taps_.bytes() + steps_.bytes() + beyond_.bytes() + layers_.bytes();
    for (const Stencil& s : stencils_)
        total += s.first_of.bytes();
    return total;
}

}  // namespace seaglare::glare
