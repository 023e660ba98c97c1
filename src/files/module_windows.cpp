#include <fmt/format.h>

#include "core/windows.hpp"
#include "files/module.hpp"
#include "files/system/program.hpp"

namespace cotan {

// Only from the program's own folder, and what the module needs only from there or from the system.
Result<const void*> loadModule(const ModuleLocations& locations, const char* entry,
                               const std::function<bool(const void*)>& fits, const char* what)
{
    const std::filesystem::path file = programFile().parent_path() / locations.name;
    const HMODULE module =
        ::LoadLibraryExW(file.c_str(), nullptr, LOAD_LIBRARY_SEARCH_DLL_LOAD_DIR | LOAD_LIBRARY_SEARCH_SYSTEM32);
    if (module == nullptr)
        return unavailableError(fmt::format("{} needs the module {}: not found", what, locations.name));
    const auto enter =
        reinterpret_cast<const void* (*)()>(reinterpret_cast<void (*)()>(::GetProcAddress(module, entry)));
    const void* const offered = enter != nullptr ? enter() : nullptr;
    if (offered != nullptr && fits(offered))
        return offered;
    return unavailableError(
        fmt::format("{} needs the module {}: {} has a different version", what, locations.name, file.string()));
}

} // namespace cotan
