#include "files/module.hpp"

#include <filesystem>
#include <string>
#include <system_error>
#include <vector>

#include <dlfcn.h>
#include <fmt/format.h>

namespace cotan {

namespace fs = std::filesystem;

namespace {

std::vector<fs::path> foldersOf(const ModulePlaces& places)
{
    std::vector<fs::path> folders;
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    if (!error)
        folders.push_back(program.parent_path().parent_path() / places.subfolder);
    if (Dl_info us; ::dladdr(reinterpret_cast<const void*>(&loadModule), &us) != 0) {
        const fs::path beside = fs::path(us.dli_fname).parent_path();
        if (beside.is_absolute()) { // not what lies in the current folder: a program is called by any name
            folders.push_back(beside);
            folders.push_back(beside / "cotan");
        }
    }
    folders.emplace_back(places.installed);
    if (*places.built != '\0')
        folders.emplace_back(places.built);
    return folders;
}

} // namespace

Result<const void*> loadModule(const ModulePlaces& places, const char* entry,
                               const std::function<bool(const void*)>& fits, const char* what)
{
    std::string problem = "not found";
    for (const fs::path& folder : foldersOf(places)) {
        const fs::path file = folder / places.name;
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
        problem = fmt::format("{} is not of this version", file.string());
    }
    return unavailableError(fmt::format("{} needs the module {}: {}", what, places.name, problem));
}

} // namespace cotan
