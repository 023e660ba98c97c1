// What the state requests, and no change of the state does: reading, writing, the clipboard, the window.
#pragma once

#include "session_parts.hpp"

namespace cotan::viewer {

// Before there is a model: hands those that are requested to the loader, and drops poses; what else is requested stays.
void beginLoads(Parts& parts);

// Does all that is requested; also opens what was chosen in the dialog, and reads again what has changed on the disk.
// What cannot be done becomes state.problem. Errors: the first of those.
Status carryOutRequests(Parts& parts);

// Watches all files that are shown: the model with its own, maps and the environment, as soon as they are chosen.
void watchShown(Parts& parts);

} // namespace cotan::viewer
