#include "core/file_names.hpp"

#include <algorithm>
#include <set>

#include "core/named_values.hpp"

namespace cotan {

namespace {

constexpr std::size_t kMaxBytes = 64; // file systems allow 255 for the whole name

unsigned char byteAt(std::string_view text, std::size_t i)
{
    return i < text.size() ? static_cast<unsigned char>(text[i]) : 0;
}

// The number of bytes of a well-formed character beyond ASCII; 0 if there is none.
std::size_t characterAt(std::string_view text, std::size_t i)
{
    const unsigned char first = byteAt(text, i), second = byteAt(text, i + 1);
    const std::size_t size = first < 0xC2 ? 0 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : first < 0xF5 ? 4 : 0;
    const bool overlong = (first == 0xE0 && second < 0xA0) || (first == 0xF0 && second < 0x90);
    const bool beyond =
        (first == 0xED && second > 0x9F) || (first == 0xF4 && second > 0x8F) || (first == 0xC2 && second < 0xA0);
    for (std::size_t k = 1; k < size; ++k)
        if ((byteAt(text, i + k) & 0xC0) != 0x80)
            return 0;
    return overlong || beyond ? 0 : size;
}

// Windows opens a device instead of a file of this name, with any ending.
bool namesDevice(const std::string& name)
{
    const std::string stem = lowerCase(name.substr(0, name.find('.')));
    const bool numbered = stem.size() == 4 && stem[3] >= '0' && stem[3] <= '9';
    return stem == "con" || stem == "prn" || stem == "aux" || stem == "nul"
        || (numbered && (stem.starts_with("com") || stem.starts_with("lpt")));
}

std::string plainPart(std::string_view name)
{
    std::string part;
    for (std::size_t i = 0; i < name.size();) {
        const char c = name[i];
        const bool kept = (c >= '0' && c <= '9') || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '-'
            || c == '_' || c == '.';
        const std::size_t size = kept ? 1 : characterAt(name, i);
        if (part.size() + std::max<std::size_t>(size, 1) > kMaxBytes)
            break;
        part += size > 0 ? name.substr(i, size) : "_";
        i += std::max<std::size_t>(size, 1);
    }
    if (part.empty())
        return "unnamed";
    for (char* const end : {&part.front(), &part.back()}) // hidden files; Windows drops a last dot
        *end = *end == '.' ? '_' : *end;
    return namesDevice(part) ? "_" + part : part;
}

} // namespace

std::string fileNamePart(std::string_view name, const std::function<bool(const std::string&)>& taken)
{
    const std::string part = plainPart(name);
    std::string found = part;
    for (int n = 2; taken && taken(found); ++n)
        found = part + "-" + std::to_string(n);
    return found;
}

std::vector<std::string> fileNameParts(const std::vector<std::string>& names, const std::vector<std::string>& taken)
{
    std::set<std::string> known;
    std::ranges::transform(taken, std::inserter(known, known.end()), lowerCase);
    std::vector<std::string> parts(names.size());
    for (const bool changed : {false, true}) // names that need no change first
        for (std::size_t i = 0; i < names.size(); ++i)
            if (parts[i].empty()
                && (changed || (fileNamePart(names[i]) == names[i] && !known.contains(lowerCase(names[i]))))) {
                parts[i] =
                    fileNamePart(names[i], [&](const std::string& part) { return known.contains(lowerCase(part)); });
                known.insert(lowerCase(parts[i]));
            }
    return parts;
}

} // namespace cotan
