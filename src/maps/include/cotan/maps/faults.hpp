// What is wrong with a normal map as a file, and how to mend it.
#pragma once

#include <string>
#include <vector>

#include "cotan/maps/green.hpp"
#include "cotan/maps/normal_statistics.hpp"

namespace cotan::maps {

struct Fault {
    enum class Kind { srgb, linearised, redAndBlue, redAndGreen, tooShort, tooLong, eightBitsIn16, greenDown };
    Kind kind{};
    std::string text; // one sentence
};

const char* name(Fault::Kind kind); // srgb, linearised, bgr, grb, washed_out, too_strong, 8_in_16, green_down

// What the numbers alone tell; of pictures that are no normal map nothing but their bits. `green`: the verdict on the
// same map, for the green channel too; null: without it.
std::vector<Fault> faultsOf(const NormalStatistics& statistics, const GreenVerdict* green = nullptr);

// The options of `cotan map convert` that mend them all, such as "--from directx,srgb --to gltf"; empty without faults.
// A map whose zero is 127.5 keeps it: green that is turned about 128 would lean by 0.45 degrees.
std::string mendingOptions(const std::vector<Fault>& faults, const NormalStatistics& statistics);

// "NAME: FAULT; FAULT; cotan map convert OPTIONS mends it."; empty without faults.
std::string sentenceOf(const std::string& name, const std::vector<Fault>& faults, const NormalStatistics& statistics);

} // namespace cotan::maps
