#include "plugin_api/api.h"

#include <array>
#include <cstddef>
#include <cstring>
#include <memory>
#include <string>

#include "plugin_api/border.h"
#include "plugin_api/context.h"
#include "plugin_api/light_files.h"
#include "plugin_api/validate.h"
#include "plugin_api/vessels.h"
#include "plugin_api/view.h"

namespace seaglare::plugin {

void report_result(Context* context, seaglare_result code, const char* text) noexcept {
    if (context == nullptr) {
        set_contextless_error(text);
        return;
    }
    context->report(code < 0 ? SEAGLARE_LOG_ERROR : SEAGLARE_LOG_WARNING, text);
}

namespace {

Context* inside(seaglare_context* context) {
    return context == nullptr ? nullptr : &context->context;
}
Context* inside(seaglare_view* view) {
    return view == nullptr ? nullptr : &view->view.context();
}

seaglare_context& required(seaglare_context* context) {
    if (context == nullptr) invalid_argument("context is NULL");
    return *context;
}
View& required(seaglare_view* view) {
    if (view == nullptr) invalid_argument("view is NULL");
    return view->view;
}
template <class Pointer>
Pointer required(Pointer pointer, const char* name) {
    if (pointer == nullptr) invalid_argument(std::string(name) + " is NULL");
    return pointer;
}

seaglare_result SEAGLARE_CALL create(const seaglare_create_info* info, seaglare_context** out) {
    if (out != nullptr) *out = nullptr;
    return at_border(nullptr, [&]() -> seaglare_result {
        required(out, "out");
        const seaglare_create_info copy = copy_struct(info, "create_info");
        check(copy);
        auto context = std::make_unique<seaglare_context>(copy);
        const std::string reason = context->context.degraded_reason();
        if (!reason.empty()) {
            set_contextless_error(reason);
            context->context.report(SEAGLARE_LOG_WARNING, reason);
        }
        *out = context.release();
        return reason.empty() ? SEAGLARE_OK : SEAGLARE_DEGRADED;
    });
}

seaglare_result SEAGLARE_CALL destroy(seaglare_context* context) {
    return at_border(inside(context), [&]() -> seaglare_result {
        if (context == nullptr) return SEAGLARE_OK;
        if (context->context.has_views())
            throw Failure(SEAGLARE_ERROR_BUSY,
                          "a view of this context still exists: call destroy_view first");
        delete context;
        return SEAGLARE_OK;
    });
}

seaglare_result SEAGLARE_CALL create_view(seaglare_context* context, const seaglare_view_info* info,
                                          seaglare_view** out) {
    if (out != nullptr) *out = nullptr;
    return at_border(inside(context), [&]() -> seaglare_result {
        required(out, "out");
        seaglare_context& owner = required(context);
        const seaglare_view_info copy = copy_struct(info, "view_info");
        check(copy);
        *out = std::make_unique<seaglare_view>(owner, copy).release();
        return SEAGLARE_OK;
    });
}

seaglare_result SEAGLARE_CALL destroy_view(seaglare_view* view, int32_t context_lost) {
    return at_border(inside(view), [&]() -> seaglare_result {
        if (view == nullptr) return SEAGLARE_OK;
        {
            const View::Hold hold(view->view);
            if (context_lost != 0) view->view.declare_context_lost();
        }
        delete view;
        return SEAGLARE_OK;
    });
}

seaglare_result SEAGLARE_CALL load_config(seaglare_context* context, const char* path) {
    return at_border(inside(context), [&]() -> seaglare_result {
        Context& owner = required(context).context;
        owner.load_config(required(path, "path"));
        const std::string reason = owner.degraded_reason();
        if (reason.empty()) return SEAGLARE_OK;
        owner.report(SEAGLARE_LOG_WARNING, reason);
        return SEAGLARE_DEGRADED;
    });
}

seaglare_result SEAGLARE_CALL load_lights(seaglare_context* context, const char* path) {
    return at_border(inside(context), [&]() -> seaglare_result {
        required(context).context.load_lights(required(path, "path"));
        return SEAGLARE_OK;
    });
}

seaglare_result SEAGLARE_CALL clear_lights(seaglare_context* context) {
    return at_border(inside(context), [&]() -> seaglare_result {
        required(context).context.clear_lights();
        return SEAGLARE_OK;
    });
}

seaglare_result SEAGLARE_CALL add_light(seaglare_context* context, const seaglare_light* light,
                                        seaglare_light_id* out_id) {
    if (out_id != nullptr) *out_id = 0;
    return at_border(inside(context), [&]() -> seaglare_result {
        Context& owner = required(context).context;
        const seaglare_light copy = copy_struct(light, "light");
        check(copy);
        const seaglare_light_id id = owner.add_light(copy);
        if (out_id != nullptr) *out_id = id;
        return SEAGLARE_OK;
    });
}

seaglare_result SEAGLARE_CALL update_lights(seaglare_context* context, const seaglare_light_update* updates,
                                            uint32_t count, uint32_t stride) {
    return at_border(inside(context), [&]() -> seaglare_result {
        required(context).context.update_lights(updates, count, stride);
        return SEAGLARE_OK;
    });
}

seaglare_result SEAGLARE_CALL remove_light(seaglare_context* context, seaglare_light_id id) {
    return at_border(inside(context), [&]() -> seaglare_result {
        required(context).context.remove_light(id);
        return SEAGLARE_OK;
    });
}

seaglare_result SEAGLARE_CALL set_body_pose(seaglare_context* context, uint32_t body_id,
                                            const double position_m[3], const double orientation[4]) {
    return at_border(inside(context), [&]() -> seaglare_result {
        required(context).context.set_body_pose(body_id, position_m, orientation);
        return SEAGLARE_OK;
    });
}

seaglare_result SEAGLARE_CALL list_lights(seaglare_context* context, seaglare_light_id* ids,
                                          uint32_t capacity, uint32_t* out_count) {
    return at_border(inside(context), [&]() -> seaglare_result {
        *required(out_count, "out_count") = 0;
        *out_count = required(context).context.list_lights(ids, capacity);
        return SEAGLARE_OK;
    });
}

seaglare_result SEAGLARE_CALL get_eye_state(seaglare_context* context, seaglare_eye_state* state) {
    return at_border(inside(context), [&]() -> seaglare_result {
        seaglare_eye_state current = required(context).context.eye_state();
        // A caller whose struct has not the fields must be able to hand its flags back.
        if (state != nullptr) current.flags &= eye_state_flags(state->struct_size);
        copy_struct_out(current, state, "eye_state");
        return SEAGLARE_OK;
    });
}

seaglare_result SEAGLARE_CALL set_eye_state(seaglare_context* context, const seaglare_eye_state* state) {
    return at_border(inside(context), [&]() -> seaglare_result {
        Context& owner = required(context).context;
        const seaglare_eye_state copy = copy_struct(state, "eye_state");
        check(copy);
        owner.set_eye_state(copy);
        return SEAGLARE_OK;
    });
}

seaglare_result SEAGLARE_CALL render(seaglare_view* view, const seaglare_frame* frame) {
    return at_border(inside(view), [&]() -> seaglare_result {
        View& owner = required(view);
        const View::Hold hold(owner);
        const seaglare_result result = owner.render(frame);
        if (result == SEAGLARE_DEGRADED)
            owner.context().report(SEAGLARE_LOG_WARNING, owner.degraded_reason());
        return result;
    });
}

seaglare_result SEAGLARE_CALL copy_last_error(seaglare_context* context, char* buffer, uint32_t size) {
    return at_border(nullptr, [&]() -> seaglare_result {
        if (buffer == nullptr || size == 0)
            return SEAGLARE_ERROR_INVALID_ARGUMENT;  // the text asked for is kept
        if (context == nullptr) {
            copy_text(contextless_error(), buffer, size);
        } else {
            copy_text(context->context.last_error().get(), buffer, size);
        }
        return SEAGLARE_OK;
    });
}

const char* SEAGLARE_CALL result_string(seaglare_result result) {
    switch (result) {
        case SEAGLARE_OK:
            return "OK";
        case SEAGLARE_NOTHING_TO_DRAW:
            return "nothing to draw: no light is visible";
        case SEAGLARE_DEGRADED:
            return "done with less than asked for: see copy_last_error";
        case SEAGLARE_ERROR_INVALID_ARGUMENT:
            return "invalid argument: fix the one that copy_last_error names";
        case SEAGLARE_ERROR_STRUCT_SIZE:
            return "wrong struct_size: set it to sizeof(the struct)";
        case SEAGLARE_ERROR_STALE_ID:
            return "stale id: the light was removed";
        case SEAGLARE_ERROR_FILE:
            return "file cannot be read: see copy_last_error";
        case SEAGLARE_ERROR_PARSE:
            return "file is not valid: copy_last_error gives line and column";
        case SEAGLARE_ERROR_OUT_OF_MEMORY:
            return "out of memory";
        case SEAGLARE_ERROR_GL:
            return "OpenGL: check the object that copy_last_error names";
        case SEAGLARE_ERROR_CONTEXT_LOST:
            return "the GL context is lost: destroy_view(view, 1), then make a new one";
        case SEAGLARE_ERROR_UNSUPPORTED:
            return "not supported on this machine";
        case SEAGLARE_ERROR_BUSY:
            return "busy: call again later";
        case SEAGLARE_ERROR_INTERNAL:
            return "a defect in Seaglare: please report copy_last_error";
        case SEAGLARE_ERROR_VERSION:
            return "ABI version: load a library of the version compiled against";
        default:
            return "unknown result code";
    }
}

seaglare_result SEAGLARE_CALL get_stats(seaglare_view* view, seaglare_stats* stats) {
    return at_border(inside(view), [&]() -> seaglare_result {
        View& owner = required(view);
        const View::Hold hold(owner);
        copy_struct_out(owner.stats(), stats, "stats");
        return SEAGLARE_OK;
    });
}

seaglare_result SEAGLARE_CALL copy_plan(seaglare_view* view, char* buffer, uint32_t size,
                                        uint32_t* out_size) {
    return at_border(inside(view), [&]() -> seaglare_result {
        View& owner = required(view);
        const View::Hold hold(owner);
        const std::string text = owner.plan();
        if (out_size != nullptr) *out_size = static_cast<uint32_t>(text.size() + 1);
        if (buffer == nullptr) {
            if (size == 0 && out_size != nullptr) return SEAGLARE_OK;
            invalid_argument("buffer is NULL");
        }
        if (size == 0) invalid_argument("size is 0");
        copy_text(text, buffer, size);
        return SEAGLARE_OK;
    });
}

seaglare_result SEAGLARE_CALL read_hdr(seaglare_view* view, float* rgba, uint64_t capacity_floats,
                                       int32_t out_size_px[2]) {
    return at_border(inside(view), [&]() -> seaglare_result {
        View& owner = required(view);
        const View::Hold hold(owner);
        owner.read_hdr(rgba, capacity_floats, out_size_px);
        return SEAGLARE_OK;
    });
}

seaglare_result SEAGLARE_CALL get_memory(seaglare_view* view, seaglare_memory* memory) {
    return at_border(inside(view), [&]() -> seaglare_result {
        View& owner = required(view);
        const View::Hold hold(owner);
        copy_struct_out(owner.memory(), memory, "memory");
        return SEAGLARE_OK;
    });
}

constexpr seaglare_memory_api memory_api = {sizeof(seaglare_memory_api), 0, get_memory};
constexpr seaglare_stats_api stats_api = {sizeof(seaglare_stats_api), 0, get_stats, copy_plan};
constexpr seaglare_hdr_api hdr_api = {sizeof(seaglare_hdr_api), 0, read_hdr};

const void* SEAGLARE_CALL get_extension(const char* name) {
    if (name == nullptr) return nullptr;
    if (std::strcmp(name, "seaglare.stats/1") == 0) return &stats_api;
    if (std::strcmp(name, "seaglare.hdr/1") == 0) return &hdr_api;
    if (std::strcmp(name, "seaglare.memory/1") == 0) return &memory_api;
    if (std::strcmp(name, "seaglare.lights/1") == 0) return &lights_api;
    if (std::strcmp(name, "seaglare.vessels/1") == 0) return &vessels_api;
    if (std::strcmp(name, "seaglare.waves/1") == 0) return &waves_api;
    return nullptr;
}

constexpr seaglare_api table = {
    .struct_size = sizeof(seaglare_api),
    .abi_minor = SEAGLARE_ABI_MINOR,
    .create = create,
    .destroy = destroy,
    .create_view = create_view,
    .destroy_view = destroy_view,
    .load_config = load_config,
    .load_lights = load_lights,
    .clear_lights = clear_lights,
    .add_light = add_light,
    .update_lights = update_lights,
    .remove_light = remove_light,
    .set_body_pose = set_body_pose,
    .list_lights = list_lights,
    .get_eye_state = get_eye_state,
    .set_eye_state = set_eye_state,
    .render = render,
    .copy_last_error = copy_last_error,
    .result_string = result_string,
    .get_extension = get_extension,
};

}  // namespace

seaglare_result fill_api(uint32_t abi_major, seaglare_api* api) noexcept {
    return at_border(nullptr, [&]() -> seaglare_result {
        if (api == nullptr) invalid_argument("api is NULL");
        if (abi_major != SEAGLARE_ABI_MAJOR) {
            throw Failure(SEAGLARE_ERROR_VERSION, "this library has ABI version " +
                                                      std::to_string(SEAGLARE_ABI_MAJOR) + ", not " +
                                                      std::to_string(abi_major));
        }
        copy_struct_out(table, api, "api");
        return SEAGLARE_OK;
    });
}

}  // namespace seaglare::plugin
