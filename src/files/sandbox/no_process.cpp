// Stubs for platforms without processes and modules.
#include "files/module.hpp"
#include "files/sandbox/confine.hpp"
#include "files/sandbox/reader_process.hpp"

namespace cotan {

Result<const void*> loadModule(const ModuleLocations& locations, const char*, const std::function<bool(const void*)>&,
                               const char* what)
{
    return unavailableError(std::string(what) + " needs the module " + locations.name + ", which cannot be loaded");
}

Result<std::unique_ptr<ReaderProcess>> ReaderProcess::start(ReaderRequest request, const std::function<void(WireOut&)>&)
{
    return unavailableError(request.name + ": this platform cannot start a process to read it");
}

struct Child::System {};
Child::~Child() = default;
ReaderProcess::~ReaderProcess() = default;
Status ReaderProcess::await() { return failure(); }
void ReaderProcess::restartClock() {}
Error ReaderProcess::failure() { return unavailableError("this platform has no processes"); }

std::optional<ParentConnection> ParentConnection::take() { return std::nullopt; }
std::size_t ParentConnection::receive(std::span<std::byte>) const { return std::size_t(in_ >= 0); } // it never is
bool ParentConnection::send(std::span<const std::byte>) const { return out_ >= 0; }

void dieWith(std::int64_t, int) {}
void confine() {}
void limitTo(const ReaderBudget&, const ReaderBudget&) {}

} // namespace cotan
