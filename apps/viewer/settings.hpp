// The options that can be changed while the image is shown, each by its name on the command line.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "picture.hpp"

namespace cotan::viewer {

struct Setting {
    // What a changed setting requires: nothing, new metering of the exposure, a reload of the model, or a new pose.
    enum class After { nothing, metering, loading, posing };

    const char* name; // option name without --
    std::function<std::string(const PictureOptions&)> get;
    std::function<bool(PictureOptions&, const std::string&)> set; // false: invalid value
    After after = After::nothing;
    bool flag = false;
    std::string expected{};           // for error messages; empty: any text
    std::vector<std::string> words{}; // valid values; empty: not a fixed list
};

std::span<const Setting> settings();
const Setting* findSetting(const std::string& name);

std::string valueOf(const Setting& setting, const PictureOptions& options);

// Errors: ErrorKind::usage, with what was expected and found; the options stay as they are.
Status setValue(const Setting& setting, const std::string& value, PictureOptions& options);

} // namespace cotan::viewer
