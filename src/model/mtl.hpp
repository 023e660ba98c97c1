// Material libraries of Wavefront OBJ.
#pragma once

#include <string>
#include <vector>

#include "source_material.hpp"

namespace cotan {

struct MtlText {
    std::vector<SourceMaterial> materials; // in the order of the file
    std::vector<std::string> warnings;     // without the file's name
};

// Reads newmtl, Kd, Ke, Ns, d, Tr, Pr, Pm and the maps map_Kd, map_Ke, map_d, map_Pr, map_Pm,
// bump (map_Bump) and norm (map_Kn), upper or lower case, with the options -bm, -clamp, -o and -s.
// All other statements are passed over; those before the first newmtl, and those whose numbers
// cannot be read, are left out with a warning. Nothing in a library is an error.
// Source: the MTL specification of the Advanced Visualizer manual; Pr, Pm, norm as in the PBR
// extension of exocortex.com.
MtlText parseMtl(std::string text);

} // namespace cotan
