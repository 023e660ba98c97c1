// Makes a normal map for another frame than the one it was made for: decodes each texel with the old
// frame at its place on the surface, and encodes the normal with the new one.
#pragma once

#include <cstddef>
#include <span>

#include "bake/lint/map_fit.hpp"
#include "cotan/convert.hpp"
#include "cotan/result.hpp"

namespace cotan {

inline constexpr std::size_t kMaxPlaces = 16; // of one texel; of more, some that are spread over all count
inline constexpr std::size_t kMaxAllPlaces = std::size_t(1)
    << 24; // of a map; larger ones have fewer of a texel, 4 at least

struct Reencoded : ReencodeFigures {
    Image image; // as large as the old one
};

// map: with all its data. bits: 8 or 16 a component of the result. expansion: of the result; none: as the map's.
// threads: 0 for all cores. rows: gets a step for each row; once it is stopped, the result is not to be used. Alpha is
// kept; texels that stand for nothing (decoded z <= 0 where no triangle is, or a map that no use covers) are kept as
// they are. Mip levels are not part of an image here: viewers make them from the result. The same result whatever the
// number of threads. `unconverted` and `error` are measured on the surface: a map may be shown without any triangle
// covering the centre of a texel.
Reencoded reencode(const Image& map, std::span<const MapUse> uses, const FramePair& frames, int bits, int threads = 0,
                   CountedSteps* rows = nullptr, std::optional<Expansion> expansion = {});

} // namespace cotan
