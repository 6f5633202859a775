#include "glare/psf/two_scale.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>

#include "glare/psf/pattern_cache.h"

namespace seaglare::glare {

namespace {

constexpr int rows_per_slice = TileLists::tile_side;
constexpr int columns_per_slice = 32;
constexpr double pupil_step_mm = 0.25;
constexpr double design_wavelength_mm = 575e-6;

// What averaging over the sample's box takes from a frequency, as the factor that gives it back.
std::vector<float> unboxing(int n) {
    std::vector<float> factors(static_cast<std::size_t>(n) / 2 + 1, 1.0F);
    for (std::size_t k = 1; k < factors.size(); ++k) {
        const double x = std::numbers::pi * static_cast<double>(k) / n;
        factors[k] = static_cast<float>(std::pow(x / std::sin(x), 2));
    }
    return factors;
}

std::uint64_t new_table_id() {
    static std::atomic<std::uint64_t> last{0};
    return last.fetch_add(1, std::memory_order_relaxed) + 1;
}

bool holds(const WideInstants& instants, const EyeInstant& eye) {
    return std::any_of(instants.list.begin(), instants.list.begin() + instants.count,
                       [&](const WideInstant& i) { return i.eye == eye; });
}

// Lids, head and focus are left at rest: a blink dims the pattern as a whole, the large bodies in the vitreous scatter
// into the core, and defocus blurs by a few minutes of arc what is degrees away.
EyeInstant wide_eye(const EyeModel& eye, double pupil_mm, double time_s, std::uint64_t seed) {
    EyeInstant instant = eye_instant(eye, pupil_mm, time_s, LidPose{}, 0, seed);
    instant.defocus_dioptre = 0;
    return instant;
}

}  // namespace

ScaleJoin scale_join(int core_transform_size) {
    // Inside half the core's field what it aliases is small; its needles carry on in the wide field's over a band that
    // is some needles wide.
    const auto half = static_cast<float>(core_transform_size) / 2;
    return {0.28F * half, 0.48F * half};
}

void WideInstants::add(const EyeInstant& eye, double weight) {
    for (int i = 0; i < count; ++i) {
        auto& present = list[static_cast<std::size_t>(i)];
        if (present.eye == eye) {
            present.weight += weight;
            return;
        }
    }
    list[static_cast<std::size_t>(count++)] = {eye, weight};
}

WideInstants wide_instants(const EyeModel& eye, const WideTime& time, double pupil_mm, double plane_width_mm,
                           std::uint64_t seed) {
    WideInstants instants;
    const double passed = time.time_s / time.interval_s;
    const double interval = std::floor(passed);
    const double later = passed - interval;
    const double pupil = std::floor(pupil_mm / pupil_step_mm);
    const double wider = pupil_mm / pupil_step_mm - pupil;
    for (int t = 0; t < 2; ++t) {
        const double time_weight = t == 0 ? 1 - later : later;
        const double at_s = (interval + t + time.intervals_ahead) * time.interval_s;
        for (int p = 0; p < 2; ++p) {
            const double diameter = drawable_pupil_mm((pupil + p) * pupil_step_mm, plane_width_mm);
            instants.add(wide_eye(eye, diameter, at_s, seed), time_weight * (p == 0 ? 1 - wider : wider));
        }
    }
    return instants;
}

WideField::WideField(const ClDevice& device, const EyeModel& eye, const PatternSettings& settings,
                     std::uint64_t seed)
    : device_(device),
      eye_(eye),
      n_(settings.wide_field_size),
      plane_width_mm_(settings.plane_width_mm),
      interval_s_(settings.wide_field_interval_s),
      seed_(seed),
      join_(scale_join(settings.transform_size)),
      moves_(wide_eye(eye, 6, 0, seed) != wide_eye(eye, 6, 1, seed)),
      aperture_(device, eye, n_, plane_width_mm_, seed),
      keep_rows_(device.program(KernelSet::pattern), "keep_rows"),
      gather_columns_(device.program(KernelSet::pattern), "gather_columns"),
      sum_along_columns_(device.program(KernelSet::pattern), "sum_along_columns"),
      sum_across_columns_(device.program(KernelSet::pattern), "sum_across_columns") {
    cl_context context = device.context();
    cl_command_queue queue = device.queue();
    const auto n = static_cast<std::size_t>(n_);
    rows_.reserve(context, queue, rows_per_slice * (n + 2) * sizeof(float), "rows of the pupil plane");
    transform_in_strips(device.is_cpu() && n_ <= WideStrips::most_samples);
    const std::vector<float> factors = unboxing(n_);
    unbox_.reserve(context, queue, factors.size() * sizeof(float), "box factors");
    unbox_.write(queue, factors.size() * sizeof(float), factors.data());
    device.finish();
}

void WideField::transform_in_strips(bool on) {
    if (on) {
        strips_.emplace(device_, n_);
        return;
    }
    strips_.reset();
    row_fft_.emplace(device_, n_, rows_per_slice, BatchFft::Kind::real);
    column_fft_.emplace(device_, n_, columns_per_slice, BatchFft::Kind::complex);
    columns_.reserve(device_.context(), device_.queue(),
                     columns_per_slice * static_cast<std::size_t>(n_) * 2 * sizeof(float),
                     "columns of the pupil plane");
}

void WideField::use_step(int step) {
    step_ = step;
    cl_context context = device_.context();
    cl_command_queue queue = device_.queue();
    const std::size_t edges = 2 * static_cast<std::size_t>(edges_of(step));
    sums_.reserve(context, queue, edges * columns_per_slice * sizeof(float), "sums of columns");
    carry_.reserve(context, queue, edges * sizeof(float), "sums so far");
    for (const auto& table : tables_) {
        table->complete = false;
        table->id = 0;
    }
    building_ = 0;
}

WideTable* WideField::find(const EyeInstant& eye) {
    const auto found = std::find_if(tables_.begin(), tables_.end(),
                                    [&](const auto& table) { return table->id != 0 && table->eye == eye; });
    return found == tables_.end() ? nullptr : found->get();
}

WideTable& WideField::claim(const EyeInstant& eye, const WideInstants& shown, const WideInstants& next) {
    auto free = std::find_if(tables_.begin(), tables_.end(), [&](const auto& table) {
        return table->id == 0 || (!holds(shown, table->eye) && !holds(next, table->eye));
    });
    if (free == tables_.end()) {
        tables_.push_back(std::make_unique<WideTable>());
        free = tables_.end() - 1;
    }
    WideTable& table = **free;
    table.complete = false;
    table.eye = eye;
    table.id = new_table_id();
    // A vector more than the entries: spread.cl reads whole vectors.
    const std::size_t floats =
        2 * static_cast<std::size_t>(edges_of(step_)) * static_cast<std::size_t>(stride_of(step_)) + 16;
    table.energy.reserve(device_.context(), device_.queue(), floats * sizeof(float), "wide field", true);
    return table;
}

WideField::Slices WideField::slices(const EyeInstant& eye) const {
    const double radius = aperture_.pupil_radius_samples(eye.pupil_mm) + 1;
    const double axis = n_ / 2.0;
    Slices s;
    s.first_tile_row = std::max(0, static_cast<int>(std::floor((axis - radius) / rows_per_slice)));
    const int end =
        std::min(aperture_.tile_rows(), static_cast<int>(std::ceil((axis + radius) / rows_per_slice)));
    s.rows = std::max(end - s.first_tile_row, 1);
    s.columns = n_ / 2 / columns_per_slice + 1;
    return s;
}

// The columns that are kept in a pass.
WideField::Columns WideField::kept_columns(const Slices& s, int pass) const {
    const int end = s.columns - pass * s.columns_per_pass();
    const int first = std::max(end - s.columns_per_pass(), 0);
    return {first * columns_per_slice, (end - first) * columns_per_slice};
}

void WideField::transform_rows(const EyeInstant& eye, const Slices& s, int pass, int slice) {
    cl_command_queue queue = device_.queue();
    if (pass == 0 && slice == 0) {
        // Room for the widest pupil so far.
        const std::size_t samples = static_cast<std::size_t>(s.rows) * rows_per_slice * 2 *
                                    static_cast<std::size_t>(kept_columns(s, 0).count);
        kept_.reserve(device_.context(), queue, samples * sizeof(cl_half), "pupil plane");
        device_.finish();  // place() uploads from memory of its own: that of the table before must have gone
        aperture_.place(eye);
    }
    aperture_.draw(eye.pupil_mm, rows_.get(), s.first_tile_row + slice, 1);
    if (strips_)
        strips_->transform_rows(queue, rows_.get(), rows_per_slice);
    else
        row_fft_->forward(queue, rows_.get());
    const Columns kept = kept_columns(s, pass);
    keep_rows_.set(rows_.get(), static_cast<cl_int>(n_ + 2), static_cast<cl_int>(2 * kept.first), kept_.get(),
                   static_cast<cl_int>(2 * kept.count), static_cast<cl_int>(slice * rows_per_slice),
                   static_cast<cl_int>(rows_per_slice));
    keep_rows_.launch(queue, static_cast<std::size_t>(kept.count) / 4, rows_per_slice, 32, 2);
}

void WideField::transform_columns(WideTable& table, const Slices& s, int pass, int slice) {
    cl_command_queue queue = device_.queue();
    // The outermost first; the last block has one column and what lies beyond the highest frequency.
    const Columns kept = kept_columns(s, pass);
    const cl_int first_column = kept.first + kept.count - (slice + 1) * columns_per_slice;
    const cl_int first_row = s.first_tile_row * rows_per_slice;
    const cl_int n = n_;
    const cl_int count = columns_per_slice;
    const cl_int edges = edges_of(step_);
    // Parseval: the sum of |F|^2 over all frequencies is n^2 times the sum of P^2, the area of the open pupil.
    const double radius = aperture_.pupil_radius_samples(table.eye.pupil_mm);
    const auto scale =
        static_cast<cl_float>(1 / (static_cast<double>(n_) * n_ * std::numbers::pi * radius * radius));
    const cl_int end_row = first_row + s.rows * rows_per_slice;
    if (strips_) {
        strips_->sum_columns(
            queue, {kept_.get(), 2 * kept.count, kept.first, first_row, end_row},
            {first_column, count, step_, edges, unbox_.get(), scale, join_.inner, join_.outer, sums_.get()});
    } else {
        gather_columns_.set(kept_.get(), static_cast<cl_int>(2 * kept.count), static_cast<cl_int>(kept.first),
                            first_row, end_row, n, first_column, count, columns_.get());
        gather_columns_.launch(queue, static_cast<std::size_t>(n_) / 8, 16);
        column_fft_->forward(queue, columns_.get());
        sum_along_columns_.set(columns_.get(), n, first_column, count, static_cast<cl_int>(step_), edges,
                               unbox_.get(), scale, join_.inner, join_.outer, sums_.get());
        sum_along_columns_.launch(queue, 2 * columns_per_slice, 4);
    }
    sum_across_columns_.set(sums_.get(), n, first_column, count, static_cast<cl_int>(step_), edges,
                            carry_.get(), table.energy.get(), static_cast<cl_int>(stride_of(step_)));
    sum_across_columns_.launch(queue, 2 * static_cast<std::size_t>(edges), 32);
}

int WideField::run(WideTable& table, int first, int last) {
    const Slices s = slices(table.eye);
    const int in_pass = s.rows + s.columns_per_pass();  // the last pass may have fewer
    constexpr int launches_per_row_slice = 3;
    const int launches_per_column_slice = strips_ ? 2 : 4;
    int launches = 0;
    for (int i = first; i < last; ++i) {
        const int pass = i / in_pass;
        const int slice = i % in_pass;
        if (slice < s.rows)
            transform_rows(table.eye, s, pass, slice);
        else
            transform_columns(table, s, pass, slice - s.rows);
        launches += slice < s.rows ? launches_per_row_slice : launches_per_column_slice;
    }
    table.complete = last >= s.all();
    return launches;
}

int WideField::advance(double time_s, double pupil_mm, double pitch) {
    // Three cells or more to a box of the screen: what lies in a cell is spread evenly over it.
    int step = 4;
    while (step > 1 && 3 * step * design_wavelength_mm > pitch * plane_width_mm_)
        step /= 2;
    if (step < step_ || tables_.empty()) use_step(std::min(step, step_));

    const WideInstants shown =
        wide_instants(eye_, {interval_s_, time_s, 0}, pupil_mm, plane_width_mm_, seed_);
    WideInstants next = wide_instants(eye_, {interval_s_, time_s, 1}, pupil_mm, plane_width_mm_, seed_);
    if (!moves_) {
        // Only the pupil's swing can ask for more: its next step, to either side.
        const double side = pupil_mm / pupil_step_mm - std::floor(pupil_mm / pupil_step_mm) < 0.5 ? -1 : 1;
        next = wide_instants(eye_, {interval_s_, time_s, 0}, pupil_mm + side * pupil_step_mm, plane_width_mm_,
                             seed_);
    }
    int launches = 0;
    const auto finish = [&](WideTable& table) {
        const bool under_way = table.id == building_;
        const int all = slices(table.eye).all();
        launches += run(table, under_way ? slices_done_ : 0, all);
        building_ = 0;
    };
    shown_count_ = 0;
    for (int i = 0; i < shown.count; ++i) {
        const WideInstant& wanted = shown.list[static_cast<std::size_t>(i)];
        WideTable* table = find(wanted.eye);
        if (table == nullptr) table = &claim(wanted.eye, shown, next);
        if (!table->complete) finish(*table);
        table->weight = wanted.weight;
        shown_[shown_count_++] = table;
    }

    // Tables for the next interval: as many slices as the time that has passed of this one.
    int missing = 0;
    int done = 0;
    int all = 0;
    for (int i = 0; i < next.count; ++i) {
        const EyeInstant& eye = next.list[static_cast<std::size_t>(i)].eye;
        if (holds(shown, eye)) continue;
        const WideTable* const table = find(eye);
        const int slices_of_it = slices(eye).all();
        all += slices_of_it;
        if (table != nullptr && table->complete)
            done += slices_of_it;
        else if (table != nullptr && table->id == building_)
            done += slices_done_;
        ++missing;
    }
    if (missing == 0) return launches;
    const double passed = time_s / interval_s_ - std::floor(time_s / interval_s_);
    int quota = static_cast<int>(std::ceil(passed * all)) - done;
    for (int i = 0; i < next.count && quota > 0; ++i) {
        const EyeInstant& eye = next.list[static_cast<std::size_t>(i)].eye;
        WideTable* table = find(eye);
        if (table != nullptr && table->complete) continue;
        if (table == nullptr || table->id != building_) {
            // Only one is under way: what another had begun is begun again.
            if (table == nullptr) table = &claim(eye, shown, next);
            building_ = table->id;
            slices_done_ = 0;
        }
        const int last = std::min(slices(eye).all(), slices_done_ + quota);
        quota -= last - slices_done_;
        launches += run(*table, slices_done_, last);
        slices_done_ = last;
        if (table->complete) building_ = 0;
    }
    return launches;
}

std::size_t WideField::device_bytes() const {
    std::size_t total = rows_.bytes() + kept_.bytes() + columns_.bytes() + unbox_.bytes() + sums_.bytes() +
                        carry_.bytes() + aperture_.device_bytes();
    total += strips_ ? strips_->device_bytes() : row_fft_->own_bytes() + column_fft_->own_bytes();
    for (const auto& table : tables_)
        total += table->energy.bytes();
    return total;
}

}  // namespace seaglare::glare
