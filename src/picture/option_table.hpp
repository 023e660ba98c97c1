// The table of picture options. Each option has all its facts there, once: the command line declares its options by it,
// the C API reads words by it, and the window shows and changes values by it.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "core/help_group.hpp"
#include "core/value_checks.hpp"
#include "cotan/picture.hpp"
#include "picture/option_words.hpp"

namespace cotan {

struct PictureOption {
    std::string name; // "shape", without hyphens
    HelpGroup group;
    std::string unit; // of its value in the help: "DEGREES"; empty for a flag
    std::string help;
    std::function<std::string(const PictureOptions&)> word; // the value; empty if there is none; a flag: on or off
    std::function<void(PictureOptions&, const std::string& word)> set; // of a word that `check` accepts
    ValueCheck check{};                                                // empty: any text
    std::vector<std::string> words{};                                  // to suggest
    std::optional<Bounded> range{};                                    // for the help
    bool closed = false;                                               // only `words` are accepted
    bool reads = false;                                                // a file, or a word that stands for one
    bool PictureOptions::*flag = nullptr;
};

// In the order of the help. All but the model and the frame.
std::span<const PictureOption> pictureOptions();

const PictureOption* findPictureOption(std::string_view name); // null if there is none

// Options of earlier versions, without hyphens, and why there are none now.
std::span<const std::pair<std::string_view, std::string_view>> removedPictureOptions();

// Sets an option from a word. Errors: ErrorKind::usage: what was expected and found, without the option's name.
Status setOption(const PictureOption& option, const std::string& word, PictureOptions& options);

// Sets options from words of the command line of `cotan render`: "--size", "640x480", "--edges=all", and a model after
// "--" or by itself. Options for files and the terminal are not accepted. Errors: ErrorKind::usage, with the option,
// what was expected and what was found.
Status readPictureWords(std::span<const std::string> words, PictureOptions& options, std::string& frame);

// Parts of the help that other commands share.
std::string upHelp(const std::string& what);     // whose up axis it is
std::string memoryHelp(const std::string& also); // what else it limits, after "image"
std::string deviceHelp(const std::string& use);  // how the help begins

} // namespace cotan
