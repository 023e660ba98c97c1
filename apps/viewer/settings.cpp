#include "settings.hpp"

#include <utility>
#include <vector>

namespace cotan::viewer {

std::span<const Setting> settings()
{
    using enum Setting::After;
    static const std::vector<Setting> all = [] {
        std::vector<Setting> made;
        for (const auto& [name, after] : {std::pair("exposure", metering),
                                          {"tone-mapping", metering},
                                          {"environment", metering},
                                          {"environment-rotation", nothing},
                                          {"environment-intensity", nothing},
                                          {"background", nothing},
                                          {"ground", nothing},
                                          {"shadow-softness", nothing},
                                          {"no-shadows", nothing},
                                          {"no-normal-maps", nothing},
                                          {"height-map", nothing},
                                          {"height-depth", nothing},
                                          {"mask", nothing},
                                          {"point-sampled", nothing},
                                          {"specular-antialiasing", nothing},
                                          {"samples", nothing},
                                          {"edges", nothing},
                                          {"shading", nothing},
                                          {"variant", loading},
                                          {"animation", posing},
                                          {"time", posing},
                                          {"shape", loading}})
            made.push_back({*findPictureOption(name), after});
        return made;
    }();
    return all;
}

const Setting* findSetting(const std::string& name)
{
    for (const Setting& setting : settings())
        if (name == setting.option.name)
            return &setting;
    return nullptr;
}

std::string valueOf(const Setting& setting, const PictureOptions& options) { return setting.option.word(options); }

Status setValue(const Setting& setting, const std::string& value, PictureOptions& options)
{
    const PictureOption& option = setting.option;
    const auto expected = [&](const std::string& what) { return usageError(option.name + ": " + what); };
    if (option.flag) {
        if (value != "on" && value != "off" && value != "toggle")
            return expected("expected on, off or toggle; found '" + value + "'");
        options.*option.flag = value == "toggle" ? !(options.*option.flag) : value == "on";
    } else if (value.empty() && option.word(PictureOptions()).empty()) {
        option.set(options, value);
    } else if (Status set = setOption(option, value, options); !set) {
        return expected(set.error().message);
    }
    return Done{};
}

} // namespace cotan::viewer
