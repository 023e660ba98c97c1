// The options that can be changed while the image is shown, each by its name on the command line.
#pragma once

#include <span>
#include <string>

#include "picture.hpp"
#include "picture/option_table.hpp"

namespace cotan::viewer {

struct Setting {
    // What a changed setting requires: nothing, new metering of the exposure, a reload of the model, or a new pose.
    enum class After { nothing, metering, loading, posing };

    const PictureOption& option;
    After after = After::nothing;
};

std::span<const Setting> settings();
const Setting* findSetting(const std::string& name);

std::string valueOf(const Setting& setting, const PictureOptions& options);

// The words are those of the command line. A flag is on, off or toggle. The empty word means none where that is the
// default. Errors: ErrorKind::usage, with what was expected and found; the options stay as they are.
Status setValue(const Setting& setting, const std::string& value, PictureOptions& options);

} // namespace cotan::viewer
