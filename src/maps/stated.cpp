#include "cotan/maps/stated.hpp"

namespace cotan::maps {

Result<Convention> conventionOf(const StatedConvention& stated, const std::string& file, int channels,
                                const std::string& option)
{
    if (channels == 1)
        return inputError(file + ": expected a normal map of two or three channels; found one (grey)");
    Convention convention = stated.convention;
    if (channels != 2 || convention.channels != Channels::xyz)
        return convention;
    if (stated.channels)
        return usageError(option + ": " + file + " stores two channels; found "
                          + (convention.kind == MapKind::objectSpace ? "object, which needs three"
                                                                     : "xyz, which are three; leave the word out"));
    convention.channels = Channels::orthographic;
    return convention;
}

} // namespace cotan::maps
