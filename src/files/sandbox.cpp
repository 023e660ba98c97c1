#include "cotan/files.hpp"

#include <utility>

namespace cotan {

namespace {

Sandbox& ofProcess()
{
    static Sandbox sandbox;
    return sandbox;
}

} // namespace

void sandboxByDefault(Sandbox sandbox) { ofProcess() = std::move(sandbox); }

Sandbox defaultSandbox() { return ofProcess(); }

} // namespace cotan
