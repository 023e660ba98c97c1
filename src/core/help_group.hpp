// The headings of options in a help.
#pragma once

namespace cotan {

// In the order of the help. `main` holds the few options that matter most.
enum class HelpGroup { main, input, output, rays, camera, light, frame, look, jobs, diagnostics, general };

} // namespace cotan
