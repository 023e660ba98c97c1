// Between the parts of writing files and what a signal does to them.
#pragma once

namespace cotan {

// Does not return where a signal on another thread is about to end the program: its parts are gone, and what would be
// said of that is not the user's concern.
void stayWhereEnding();

} // namespace cotan
