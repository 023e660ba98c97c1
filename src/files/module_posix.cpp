#include "files/module.hpp"

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include <dlfcn.h>
#include <fmt/format.h>

#include "files/system/program.hpp"

namespace cotan {

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> foldersOf(const ModuleLocations& locations)
{
    std::vector<fs::path> folders;
    if (const fs::path program = programFile(); !program.empty())
        folders.push_back(program.parent_path().parent_path() / locations.subfolder);
    if (Dl_info us; ::dladdr(reinterpret_cast<const void*>(&loadModule), &us) != 0) {
        const fs::path beside = fs::path(us.dli_fname).parent_path();
        if (beside.is_absolute()) { // not relative to the current folder, if a program is called by a bare name
            folders.push_back(beside);
            folders.push_back(beside / "cotan");
        }
    }
    folders.emplace_back(locations.installed);
    if (*locations.built != '\0')
        folders.emplace_back(locations.built);
    return folders;
}

} // namespace

Result<const void*> loadModule(const ModuleLocations& locations, const char* entry,
                               const std::function<bool(const void*)>& fits, const char* what)
{
    std::string problem = "not found";
    for (const fs::path& folder : foldersOf(locations)) {
        const fs::path file = folder / locations.name;
        std::error_code error;
        if (!fs::exists(file, error))
            continue;
        void* module = ::dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
        if (!module) {
            problem = ::dlerror();
            continue;
        }
        const auto enter = reinterpret_cast<const void* (*)()>(::dlsym(module, entry));
        const void* offered = enter ? enter() : nullptr;
        if (offered && fits(offered))
            return offered;
        problem = fmt::format("{} has a different version", file.string());
    }
    return unavailableError(fmt::format("{} needs the module {}: {}", what, locations.name, problem));
}

} // namespace cotan
