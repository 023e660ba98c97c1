#include "cotan/maps.hpp"

#include <utility>
#include <vector>

#include "maps/texels.hpp"
#include "srgb.hpp"

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
        return about(
            option,
            usageError(file + " stores two channels; found "
                       + (convention.kind == MapKind::objectSpace ? "object, which needs three"
                                                                  : "xyz, which are three; leave the word out")));
    convention.channels = Channels::orthographic;
    return convention;
}

void undo(const Damage& damage, Image& image)
{
    if (!damage.any())
        return;
    forRowBands(image.height, [&](int first, int last) {
        std::vector<glm::vec4> row(std::size_t(image.width));
        for (int y = first; y < last; ++y) {
            loadRow(image, y, row);
            for (glm::vec4& t : row) {
                if (damage.curve == Damage::Curve::srgb)
                    t = {fromSrgb(t.x), fromSrgb(t.y), fromSrgb(t.z), t.w};
                else if (damage.curve == Damage::Curve::linearised)
                    t = {toSrgb(t.x), toSrgb(t.y), toSrgb(t.z), t.w};
                if (damage.order == Damage::Order::bgr)
                    std::swap(t.x, t.z);
                else if (damage.order == Damage::Order::grb)
                    std::swap(t.x, t.y);
            }
            storeRow(image, y, row);
        }
    });
}

} // namespace cotan::maps
