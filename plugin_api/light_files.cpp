// "seaglare.lights/1": light files that change while the host runs.
#include "plugin_api/light_files.h"

#include <string>

#include "plugin_api/border.h"
#include "plugin_api/validate.h"

namespace seaglare::plugin {

namespace {

Context* inside(seaglare_context* context) {
    return context == nullptr ? nullptr : &context->context;
}

Context& required(seaglare_context* context) {
    if (context == nullptr) invalid_argument("context is NULL");
    return context->context;
}

std::string required_path(const char* path) {
    if (path == nullptr) invalid_argument("path is NULL");
    return path;
}

seaglare_result SEAGLARE_CALL reload(seaglare_context* context, const char* path,
                                     seaglare_reload_counts* counts) {
    return at_border(inside(context), [&]() -> seaglare_result {
        Context& owner = required(context);
        const std::string file = required_path(path);
        // A wrong struct_size is refused before anything is done.
        if (counts != nullptr) static_cast<void>(copy_struct(counts, "reload_counts"));
        const seaglare_reload_counts result = owner.reload_lights(file);
        if (counts != nullptr) copy_struct_out(result, counts, "reload_counts");
        return SEAGLARE_OK;
    });
}

seaglare_result SEAGLARE_CALL save(seaglare_context* context, const char* path) {
    return at_border(inside(context), [&]() -> seaglare_result {
        Context& owner = required(context);
        owner.save_lights(required_path(path));
        return SEAGLARE_OK;
    });
}

}  // namespace

const seaglare_lights_api lights_api = {sizeof(seaglare_lights_api), 0, reload, save};

}  // namespace seaglare::plugin
