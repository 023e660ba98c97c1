// Where programs load no modules.
#include "files/module.hpp"

namespace cotan {

Result<const void*> loadModule(const ModulePlaces& places, const char*, const std::function<bool(const void*)>&,
                               const char* what)
{
    return unavailableError(std::string(what) + " needs the module " + places.name + ", which is not loaded here");
}

} // namespace cotan
