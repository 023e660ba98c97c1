// How a normal map is stored, in words.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "cotan/convention.hpp"
#include "cotan/result.hpp"

namespace cotan {

// A convention in words separated by commas: a preset's name, then what differs from it, such as "unity,xy" or
// "opengl,biased". Errors (ErrorKind::usage): a word that is not known, or none.
Result<Convention> conventionFromWords(std::string_view text);

// What went wrong with the stored values of a map, and is undone when it is read.
struct Damage {
    enum class Curve {
        none,
        srgb,
        linearised
    };                                  // srgb: saved as a colour; linearised: the sRGB curve was undone on
                                        // values that never had it
    enum class Order { rgb, bgr, grb }; // bgr: red and blue are exchanged; grb: red and green
    Curve curve = Curve::none;
    Order order = Order::rgb;

    bool any() const { return curve != Curve::none || order != Order::rgb; }
};

// A convention as somebody says it. What a preset says of channels is no more than what is usual: a file that stores
// two is believed.
struct StatedConvention {
    Convention convention{};
    bool channels = false; // they were said by a word of their own: a file that stores others contradicts
    Damage damage{};       // by the words srgb, linearised, bgr and grb

    StatedConvention() = default;
    StatedConvention(const Convention& c, bool said = false) : convention(c), channels(said) {}
};

// As conventionFromWords, with whether a word for the channels (xyz, xy and so on, or object) was among them. Takes the
// words of damageWords, too, which others refuse: nothing is to be written so.
Result<StatedConvention> statedFromWords(std::string_view text);

// The words for Damage, for help and completion: srgb, linearised, bgr, grb.
std::vector<std::string> damageWords();

// As conventionFromWords, for a shader: a preset without a word for its channels means what its engine samples
// (onCard).
Result<Convention> sampledFromWords(std::string_view text);

// All words that it knows, for help texts.
std::string conventionWords();
std::vector<std::string> conventionWordList();

} // namespace cotan
