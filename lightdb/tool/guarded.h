// What the commands of seaglare-lights share: how errors become exit statuses, and how files are written.
#pragma once

#include <fstream>
#include <ostream>
#include <string>
#include <system_error>

#include "lightdb/json/value.h"

namespace seaglare::lights_tool {

// Errors of the input are 1, of the file system 2.
template <class Work>
int guarded(std::ostream& err, const Work& work) {
    try {
        return work();
    } catch (const std::system_error& error) {
        err << "seaglare-lights: " << error.what() << "\n";
        return 2;
    } catch (const json::Error& error) {
        err << error.what() << "\n";
        return 1;
    }
}

inline bool write_file(const std::string& path, const std::string& text, std::ostream& err) {
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    file << text;
    file.close();
    if (file) return true;
    err << "seaglare-lights: cannot write " << path << "\n";
    return false;
}

}  // namespace seaglare::lights_tool
