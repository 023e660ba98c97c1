// Maps of cotan.h, read as the words of their convention say.
#pragma once

#include "cotan/maps.hpp"
#include "image_views.hpp"
#include "maps/texels.hpp"

namespace cotan::c {

// A map with x and y in red and green and without damage. to, normalise: how it is written.
struct ReadableMap {
    Image image;
    Convention from{}, to{};
    bool normalise = false;
};

// from, to: words, and their names in messages. `from` may be auto; `to` may be null: as the map is then read. An array
// does not say how many channels its file stored: it has two if z is missing, unless a word states another number.
inline ReadableMap readableMap(const cotan_image_view* given, const char* name, const char* from, const char* fromName,
                               const char* to, const char* toName)
{
    ReadableMap map{imageOf(given, name)};
    const bool finds = word(from, fromName) == "auto";
    StatedConvention stated, written;
    if (to)
        written = valueOf(parseWrittenConvention(to), toName);
    if (finds) {
        const auto look = [&](const Damage& damage) -> Result<maps::GreenVerdict> {
            if (!damage.any())
                return maps::greenOf(map.image);
            Image undone = map.image;
            maps::undo(damage, undone);
            return maps::greenOf(undone);
        };
        const maps::FoundMap found = valueOf(maps::findMap(fromName, written, look));
        stated = found.from;
        written = found.to;
        map.normalise = found.normalise;
    } else {
        stated = valueOf(parseStatedConvention(from), fromName);
    }
    if (!stated.channels && maps::lacksZ(map.image))
        map.image.channels = 2;
    map.from = valueOf(maps::makeReadable(map.image, stated, name, fromName));
    map.to = to ? written.convention : map.from;
    return map;
}

} // namespace cotan::c
