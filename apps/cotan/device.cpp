#include "device.hpp"

namespace cotan::app {

Result<std::unique_ptr<Painter>> openDevice(const std::string& device, const CommonOptions& common)
{
    auto painter = openPainter(device, common.threads);
    if (painter && !(*painter)->note.empty())
        warn(common, (*painter)->note);
    return painter;
}

} // namespace cotan::app
