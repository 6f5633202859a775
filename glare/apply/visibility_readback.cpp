#include "glare/apply/visibility_readback.h"

#include <algorithm>

namespace seaglare::glare {

VisibilityReadback::~VisibilityReadback() {
    for (Slot& slot : slots_) {
        if (slot.fence != nullptr) gl_.DeleteSync(slot.fence);
    }
}

void VisibilityReadback::poll(bool anew) {
    if (anew) {
        known_.clear();
        known_frame_ = frame_;
    }
    for (Slot& slot : slots_) {
        if (slot.fence == nullptr) continue;
        const GLenum state = gl_.ClientWaitSync(slot.fence, 0, 0);
        if (state == GL_TIMEOUT_EXPIRED) continue;
        gl_.DeleteSync(slot.fence);
        slot.fence = nullptr;
        if (state != GL_WAIT_FAILED && slot.frame > known_frame_) take(slot);
    }
}

void VisibilityReadback::take(Slot& slot) {
    const std::size_t count = slot.tags.size();
    gl_.BindBuffer(GL_PIXEL_PACK_BUFFER, slot.buffer.name());
    const auto* values = static_cast<const float*>(gl_.MapBufferRange(
        GL_PIXEL_PACK_BUFFER, 0, static_cast<GLsizeiptr>(count * sizeof(float)), GL_MAP_READ_BIT));
    if (values != nullptr) {
        known_.resize(count);
        for (std::size_t i = 0; i < count; ++i)
            known_[i] = {slot.tags[i], values[i]};
        gl_.UnmapBuffer(GL_PIXEL_PACK_BUFFER);
        const auto by_tag = [](const Value& a, const Value& b) { return a.tag < b.tag; };
        if (!std::is_sorted(known_.begin(), known_.end(), by_tag))
            std::sort(known_.begin(), known_.end(), by_tag);
        known_frame_ = slot.frame;
    }
    gl_.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

bool VisibilityReadback::begin(std::span<const std::uint32_t> tags, bool must) {
    ++frame_;
    const auto unused =
        std::find_if(slots_.begin(), slots_.end(), [](const Slot& slot) { return slot.fence == nullptr; });
    current_ = unused != slots_.end() ? &*unused : nullptr;
    if (current_ == nullptr) {
        if (!must) return false;
        current_ = &*std::min_element(slots_.begin(), slots_.end(),
                                      [](const Slot& a, const Slot& b) { return a.frame < b.frame; });
        gl_.DeleteSync(current_->fence);
        current_->fence = nullptr;
    }
    current_->frame = frame_;
    current_->tags.assign(tags.begin(), tags.end());
    // The others as well: the first frame in which the GPU is that far behind is to allocate nothing.
    for (Slot& slot : slots_) {
        slot.tags.reserve(tags.size());
        if (!slot.buffer) slot.buffer = GlObject(gl_, GlKind::buffer);
    }
    offset_ = 0;
    return true;
}

void VisibilityReadback::make_room(Slot& slot, std::size_t bytes) {
    gl_.BindBuffer(GL_PIXEL_PACK_BUFFER, slot.buffer.name());
    gl_.BufferData(GL_PIXEL_PACK_BUFFER, static_cast<GLsizeiptr>(bytes), nullptr, GL_STREAM_READ);
    slot.bytes = bytes;
}

void VisibilityReadback::read(int width, int first_row, int rows) {
    if (current_ == nullptr) return;
    gl_.BindBuffer(GL_PIXEL_PACK_BUFFER, current_->buffer.name());
    // Whole rows are read, of which the last may be more than the lights.
    const std::size_t row_bytes = static_cast<std::size_t>(width) * sizeof(float);
    const std::size_t all_rows = (current_->tags.size() * sizeof(float) + row_bytes - 1) / row_bytes;
    const std::size_t needed = all_rows * row_bytes;
    if (current_->bytes < needed) {
        // What a slot under way has been filled with is still to be read.
        for (Slot& slot : slots_)
            if (slot.fence == nullptr && slot.bytes < needed) make_room(slot, needed);
        gl_.BindBuffer(GL_PIXEL_PACK_BUFFER, current_->buffer.name());
    }
    // An offset into the buffer bound, as GL has it.
    gl_.ReadPixels(0, first_row, width, rows, GL_RED, GL_FLOAT, reinterpret_cast<void*>(offset_));
    offset_ += static_cast<std::size_t>(rows) * row_bytes;
    gl_.BindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

void VisibilityReadback::end() {
    if (current_ == nullptr) return;
    current_->fence = gl_.FenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
    current_ = nullptr;
}

void VisibilityReadback::end_now() {
    if (current_ == nullptr) return;
    take(*current_);  // mapping waits for the pixels
    current_ = nullptr;
}

std::optional<float> VisibilityReadback::known(std::uint32_t tag) const {
    const auto found = std::lower_bound(known_.begin(), known_.end(), tag,
                                        [](const Value& value, std::uint32_t t) { return value.tag < t; });
    if (found == known_.end() || found->tag != tag) return std::nullopt;
    return found->visibility;
}

double VisibilityReadback::memory_bytes() const {
    double bytes = 0;
    for (const Slot& slot : slots_)
        bytes += static_cast<double>(slot.bytes);
    return bytes;
}

void VisibilityReadback::forget() {
    for (Slot& slot : slots_) {
        slot.buffer.forget();
        slot.fence = nullptr;
    }
}

}  // namespace seaglare::glare
