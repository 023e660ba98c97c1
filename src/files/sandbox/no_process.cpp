// Where there are neither processes nor modules.
#include "files/module.hpp"
#include "files/sandbox/confine.hpp"
#include "files/sandbox/process.hpp"

namespace cotan {

Result<const void*> loadModule(const ModulePlaces& places, const char*, const std::function<bool(const void*)>&,
                               const char* what)
{
    return unavailableError(std::string(what) + " needs the module " + places.name + ", which is not loaded here");
}

Result<std::unique_ptr<ReaderProcess>> ReaderProcess::start(ReaderRequest request, const std::function<void(WireOut&)>&)
{
    return unavailableError(request.name + ": there are no processes here that could read it");
}

ReaderProcess::~ReaderProcess() = default;
Status ReaderProcess::await() { return failure(); }
void ReaderProcess::restartClock() {}
Error ReaderProcess::failure() { return unavailableError("there are no processes here"); }

void Descriptor::close() {}

void dieWith(std::int64_t, int) {}
void confine() {}
void limitTo(const ReaderBudget&, const ReaderBudget&) {}

} // namespace cotan
