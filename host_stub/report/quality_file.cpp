#include "host_stub/report/quality_file.h"

#include <fstream>
#include <set>
#include <stdexcept>

#include "lightdb/json/value.h"
#include "lightdb/json/writer.h"

namespace seaglare::report {

namespace {

// What of the changes lies below a key, with the key taken off.
Changes below(const Changes& changes, const std::string& key) {
    Changes inner;
    for (const auto& [path, text] : changes)
        if (path.starts_with(key + ".")) inner.emplace(path.substr(key.size() + 1), text);
    return inner;
}

class Copier {
  public:
    explicit Copier(json::Writer& out) : out_(out) {}

    void object(const json::Value* from, const Changes& changes, const std::filesystem::path& folder) {
        out_.begin_object();
        std::set<std::string> written;
        if (from != nullptr) {
            for (const json::Member& member : from->object()) {
                const std::string name(member.name());
                written.insert(name);
                if (name == "$schema" || name == "source") continue;
                one(name, &member.value(), changes, folder);
            }
        }
        for (const auto& [path, text] : changes) {
            const std::string name = path.substr(0, path.find('.'));
            if (written.insert(name).second) one(name, nullptr, changes, folder);
        }
        out_.end_object();
    }

  private:
    void one(const std::string& name, const json::Value* value, const Changes& changes,
             const std::filesystem::path& folder) {
        if (const auto changed = changes.find(name); changed != changes.end()) {
            if (changed->second.empty()) return;
            const json::Document document = json::parse(changed->second, name);
            out_.member(name, document.root());
            return;
        }
        const Changes inner = below(changes, name);
        // A file that is named is taken in.
        if (value != nullptr && value->kind() == json::Kind::string && (name == "eye" || name == "display")) {
            const std::filesystem::path file = folder / std::filesystem::path(std::string(value->string()));
            const json::Document document = json::parse_file(file.string());
            out_.key(name);
            object(&document.root(), inner, file.parent_path());
            return;
        }
        out_.key(name);
        if (inner.empty() && value != nullptr)
            out_.value(*value);
        else
            object(value, inner, folder);
    }

    json::Writer& out_;
};

}  // namespace

void write_quality(const std::filesystem::path& base, const Changes& changes,
                   const std::filesystem::path& to) {
    const json::Document document = json::parse_file(base.string());
    json::Writer out;
    Copier(out).object(&document.root(), changes, base.parent_path());
    std::ofstream file(to, std::ios::binary);
    file << out.take();
    if (!file.flush()) throw std::runtime_error("cannot write " + to.string());
}

}  // namespace seaglare::report
