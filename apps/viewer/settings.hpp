// The options of a picture that can be changed while it is looked at, each by its name on the command line.
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "picture.hpp"

namespace cotan::viewer {

struct Setting {
    // What comes after a change: nothing, or the exposure is found again, the model read again or put into its pose.
    enum class After { nothing, metering, loading, posing };

    const char* name; // of the option, without --
    std::function<std::string(const PictureOptions&)> get;
    std::function<bool(PictureOptions&, const std::string&)> set; // false: not such a value
    After after = After::nothing;
    bool flag = false;
    std::string expected{};           // for messages; empty: anything
    std::vector<std::string> words{}; // that it may have; empty: others
};

std::span<const Setting> settings();
const Setting* findSetting(const std::string& name);

std::string valueOf(const Setting& setting, const PictureOptions& options);

// Errors: ErrorKind::usage, with what was expected and found; the options stay as they are.
Status setValue(const Setting& setting, const std::string& value, PictureOptions& options);

} // namespace cotan::viewer
