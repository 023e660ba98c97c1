#include "bake/name_pairs.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>

#include "core/named_values.hpp"

namespace cotan {

namespace {

constexpr Named<NameRole> kWords[] = {
    {"low", NameRole::low},     {"lo", NameRole::low},        {"lp", NameRole::low},
    {"lowpoly", NameRole::low}, {"high", NameRole::high},     {"hi", NameRole::high},
    {"hp", NameRole::high},     {"highpoly", NameRole::high}, {"cage", NameRole::cage}};
constexpr const char* kSeparators = "._ -";
constexpr const char* kDigits = "0123456789";
constexpr std::size_t kMaxEnding = 200; // bytes: each of its parts is looked up

struct Parts {
    std::string base, number, ending; // in lower case
    NameRole role = NameRole::none;

    auto key() const { return std::tuple(base, number, ending); }
};

bool isLower(char c) { return c >= 'a' && c <= 'z'; }
bool isUpper(char c) { return c >= 'A' && c <= 'Z'; }
bool isLetter(char c) { return isLower(c) || isUpper(c) || static_cast<unsigned char>(c) >= 128; }

// Removes a number of Blender, a dot and three or more digits, from the end.
std::string takeNumber(std::string& name)
{
    const std::size_t dot = name.find_last_not_of(kDigits);
    if (dot == std::string::npos || name[dot] != '.' || name.size() - dot < 4)
        return {};
    std::string number = name.substr(dot + 1);
    name.resize(dot);
    return number;
}

std::string trimmed(const std::string& text)
{
    const std::size_t from = std::min(text.find_first_not_of(kSeparators), text.size());
    return text.substr(from, text.find_last_not_of(kSeparators) + 1 - from);
}

Parts partsOf(std::string name)
{
    Parts parts{.base = {}, .number = takeNumber(name), .ending = {}};
    std::size_t from = name.size(), to = name.size(); // of the last known word
    for (std::size_t begin = 0, end = 0; begin < name.size(); begin = std::max(end, begin + 1)) {
        for (end = begin; end < name.size() && isLetter(name[end]); ++end)
            if (end > begin && isLower(name[end - 1]) && isUpper(name[end]))
                break;
        if (const auto role = valueOf(kWords, lowerCase(name.substr(begin, end - begin))))
            std::tie(parts.role, from, to) = std::tuple(*role, begin, end);
    }
    name = lowerCase(std::move(name));
    parts.base = parts.role == NameRole::none ? name : trimmed(name.substr(0, from));
    parts.ending = trimmed(name.substr(to));
    if (parts.base.empty())
        std::swap(parts.base, parts.ending);
    if (parts.number.empty())
        parts.number = takeNumber(parts.base);
    parts.ending.resize(std::min(parts.ending.size(), kMaxEnding));
    return parts;
}

using GroupsByName = std::map<std::tuple<std::string, std::string, std::string>, std::int64_t>;

// The group of the simple mesh that a detailed one fits best; -1 if there is none.
std::int64_t bestGroup(const GroupsByName& groups, const Parts& high)
{
    for (const std::string& number : {high.number, std::string()})
        for (std::size_t length = high.ending.size();;) {
            if (const auto found = groups.find({high.base, number, high.ending.substr(0, length)});
                found != groups.end())
                return found->second;
            if (length == 0)
                break;
            const std::size_t separator = high.ending.find_last_of(kSeparators, length - 1);
            length = separator == std::string::npos ? 0 : separator;
        }
    return -1;
}

// Up to three of the names.
std::string listOf(const std::set<std::string>& names)
{
    std::string list;
    std::size_t count = 0;
    for (const std::string& name : names)
        if (++count <= 3)
            list += (count > 1 ? ", '" : "'") + name + "'";
    return count > 3 ? fmt::format("{} and {} more", list, count - 3) : list;
}

} // namespace

NameRole roleOfName(std::string_view name) { return partsOf(std::string(name)).role; }

NamePairs pairNames(const std::vector<std::string>& low, const std::vector<std::string>& high)
{
    NamePairs pairs;
    GroupsByName groups;
    std::vector<std::string> bases;     // of the simple meshes
    std::vector<std::string> simple;    // the first simple mesh of each group
    std::set<std::string> shared, left; // names for notes
    bool sure = true;                   // the words say which mesh is what
    for (const std::string& name : low) {
        const Parts parts = partsOf(name);
        const auto group = groups.try_emplace(parts.key(), std::int64_t(simple.size())).first->second;
        if (std::size_t(group) == simple.size())
            simple.push_back(name);
        else if (name != simple[std::size_t(group)])
            shared.insert(name);
        sure = sure && parts.role == NameRole::low;
        bases.push_back(parts.base);
        pairs.low.push_back(group);
    }

    std::vector<Parts> highParts;
    std::set<std::string> saysHigh; // bases
    for (const std::string& name : high) {
        highParts.push_back(partsOf(name));
        sure = sure && highParts.back().role == NameRole::high;
        if (highParts.back().role == NameRole::high)
            saysHigh.insert(highParts.back().base);
    }
    std::map<std::int64_t, std::string> detail; // the first detailed mesh of each group
    std::map<std::string, std::set<std::int64_t>> groupsOfBase;
    for (std::size_t i = 0; i < high.size(); ++i) {
        const Parts& parts = highParts[i];
        pairs.high.push_back(-1);
        if (parts.role != NameRole::high && saysHigh.contains(parts.base))
            continue;
        std::int64_t group = bestGroup(groups, parts);
        if (group < 0) // detail that fits no simple mesh exactly: a group for all that have this base
            group = groups.try_emplace({parts.base, "?", "?"}, std::int64_t(groups.size())).first->second;
        pairs.high[i] = group;
        groupsOfBase[parts.base].insert(group);
        detail.try_emplace(group, high[i]);
    }

    for (std::size_t i = 0; i < low.size(); ++i)
        if (std::int64_t& group = pairs.low[i]; !detail.contains(group)) {
            const std::set<std::int64_t>& all = groupsOfBase[bases[i]];
            group = all.size() == 1 ? *all.begin() : -1;
            if (group >= 0)
                shared.insert(low[i]);
        }
    const std::set<std::int64_t> used(pairs.low.begin(), pairs.low.end());
    for (std::size_t i = 0; i < high.size(); ++i)
        if (pairs.high[i] >= 0 && !used.contains(pairs.high[i])) {
            pairs.high[i] = -1;
            left.insert(high[i]);
        }
    if (!shared.empty())
        pairs.notes.push_back(
            fmt::format("no high mesh is named for {} alone: those of similar names are used", listOf(shared)));
    if (!left.empty())
        pairs.notes.push_back(fmt::format("no low mesh has the name of {}: not baked", listOf(left)));
    if (sure && used.size() > 1 && !used.contains(-1) && pairs.notes.empty())
        pairs.example = fmt::format("'{}' with '{}'", low[0], detail[pairs.low[0]]);
    return pairs;
}

} // namespace cotan
