// Performs requests that need more than a change of the state: reading, writing, the clipboard, the window.
#pragma once

#include "session_parts.hpp"

namespace cotan::viewer {

// Before there is a model: passes load requests to the loader, drops pose requests, and keeps all others.
void beginLoads(Parts& parts);

// Performs all requests; also opens the file chosen in the dialog, and reloads files that have changed on disk. Errors
// are stored in state.problem; returns the first one.
Status carryOutRequests(Parts& parts);

// Watches all displayed files as soon as they are chosen: the model with its files, maps and the environment.
void watchShown(Parts& parts);

} // namespace cotan::viewer
