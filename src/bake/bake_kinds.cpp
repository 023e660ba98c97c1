#include "bake/bake_kinds.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/parse_number.hpp"

namespace cotan {

namespace {

constexpr std::string_view kChannelNames = "RGBA";

// The text before `mark`, which is removed with it from `rest`; the whole text without one.
std::string_view before(std::string_view& rest, char mark)
{
    const std::size_t at = rest.find(mark);
    const std::string_view part = rest.substr(0, at);
    rest = at == std::string_view::npos ? std::string_view() : rest.substr(at + 1);
    return part;
}

std::string scalarNames()
{
    std::string names;
    for (const auto& [word, kind] : kBakeKinds)
        if (holdsScalars(kind))
            names += fmt::format("{}{}", names.empty() ? "" : ", ", word);
    return names;
}

} // namespace

std::vector<BakeKind> kindsOf(const BakeModelOptions& options)
{
    std::vector<BakeKind> kinds = options.kinds;
    if (kinds.empty() && options.packed.empty())
        kinds.push_back(options.bake.kind);
    for (const PackedMap& map : options.packed)
        for (const std::optional<BakeKind>& kind : map.kinds)
            if (kind && std::ranges::find(kinds, *kind) == kinds.end())
                kinds.push_back(*kind);
    return kinds;
}

Result<PackedMap> parsePackedMap(std::string_view text)
{
    if (text == kPackedOrm)
        return parsePackedMap("orm:R=ao,G=roughness,B=metallic");
    PackedMap map;
    std::string_view rest = text;
    if (text.find(':') != std::string_view::npos)
        map.name = before(rest, ':');
    for (const char c : map.name)
        if (!isLetter(c) && !isDigit(c) && c != '-' && c != '_')
            return usageError(fmt::format("expected a name of letters, digits, - and _; found '{}'", map.name));
    if (map.name.empty())
        return usageError(fmt::format("expected a name before ':'; found '{}'", text));
    std::string given;
    do {
        std::string_view value = before(rest, ',');
        const std::string_view channel = before(value, '=');
        const std::size_t at =
            channel.size() == 1 ? kChannelNames.find(upperLetter(channel[0])) : std::string_view::npos;
        if (at == std::string_view::npos || value.empty() || text.back() == ',')
            return usageError(
                fmt::format("expected orm, or channels such as R=ao,G=roughness,B=metallic,A=1; found '{}'", text));
        if (given.find(kChannelNames[at]) != std::string::npos)
            return usageError(fmt::format("expected each channel once; found {} twice", channel));
        given += kChannelNames[at];
        map.kinds[at] = valueOf(kBakeKinds, value);
        float& constant = map.constants[at];
        if (map.kinds[at] ? !holdsScalars(*map.kinds[at])
                          : !(parseNumber(value, constant) && constant >= 0 && constant <= 1))
            return usageError(
                fmt::format("{}: expected a map of one value per texel ({}) or a number from 0 to 1; found "
                            "'{}'",
                            channel, scalarNames(), value));
    } while (!rest.empty());
    if (std::none_of(map.kinds.begin(), map.kinds.end(), [](const auto& kind) { return kind.has_value(); }))
        return usageError(fmt::format("expected a map in one of the channels; found constants only: '{}'", text));
    return map;
}

} // namespace cotan
