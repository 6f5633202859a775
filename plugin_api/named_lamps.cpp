#include "plugin_api/named_lamps.h"

#include "plugin_api/failure.h"

namespace seaglare::plugin {

lightdb::SharedLightSpectrum NamedLamps::find(const std::string& name, const Colours& shown) {
    if (lightdb::is_lamp_file(name)) {
        invalid_argument(
            "light.spectrum \"" + name +
            "\" is a file: it takes the name of a lamp, and spectra from files belong into light files");
    }
    const std::lock_guard lock(mutex_);
    const auto found = known_.find({name, shown});
    if (found != known_.end()) return found->second;
    lightdb::LightSpectrum chosen;
    chosen.choice[0].source = name;
    try {
        return known_.insert({{name, shown}, lightdb::resolved(std::move(chosen), shown, shelf_)})
            .first->second;
    } catch (const lightdb::LampError& error) {
        invalid_argument(std::string("light.spectrum: ") + error.what());
    }
}

}  // namespace seaglare::plugin
