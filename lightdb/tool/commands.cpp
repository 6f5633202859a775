#include "lightdb/tool/commands.h"

#include <algorithm>
#include <ostream>

#include "lightdb/json/value.h"
#include "lightdb/light_file.h"
#include "lightdb/tool/guarded.h"

namespace seaglare::lights_tool {

int validate(const std::vector<std::string>& files, std::ostream& out, std::ostream& err) {
    int status = 0;
    for (const std::string& file : files) {
        const int result = guarded(err, [&] {
            const lightdb::LightFileCheck check = lightdb::check_light_file(file);
            for (const std::string& error : check.errors)
                err << error << "\n";
            if (!check.complete) err << file << ": and more errors: these are the first\n";
            for (const std::string& warning : check.warnings)
                err << warning << " (warning)\n";
            out << file << ": " << check.light_count << " lights, ";
            if (!check.errors.empty()) out << check.errors.size() << " errors, ";
            out << check.warnings.size() << " warnings\n";
            return check.errors.empty() ? 0 : 1;
        });
        status = std::max(status, result);
    }
    return status;
}

int check_json(const std::string& file, std::ostream& err) {
    return guarded(err, [&] {
        json::parse_file(file);
        return 0;
    });
}

}  // namespace seaglare::lights_tool
