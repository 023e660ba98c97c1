// The options of a picture that can be changed while it is looked at, each by its name on the command line.
#pragma once

#include <span>
#include <string>
#include <variant>
#include <vector>

#include "picture.hpp"

namespace cotan::viewer {

struct Setting {
    using Options = PictureOptions;
    const char* name; // of the option, without --
    std::variant<std::string Options::*, double Options::*, float Options::*, int Options::*, bool Options::*> field;
    std::vector<std::string> words{}; // that it may have; empty: any
    double low = 0, high = 0;         // of numbers
    bool meters = false;              // the exposure is found again
    bool loads = false;               // the model is read again
    bool poses = false;               // it is put into another pose
};

std::span<const Setting> settings();
const Setting* findSetting(const std::string& name);

std::string valueOf(const Setting& setting, const PictureOptions& options);

// Errors: ErrorKind::usage, with what was expected and found; the options stay as they are.
Status setValue(const Setting& setting, const std::string& value, PictureOptions& options);

} // namespace cotan::viewer
