#include "file_words.hpp"

#include <algorithm>
#include <map>
#include <string_view>

#include "core/named_values.hpp"

namespace cotan::app {

std::string (*systemFileOf)(const std::string&) = nullptr;

namespace {

struct LongerFirst {
    bool operator()(const std::string& a, const std::string& b) const
    {
        return a.size() != b.size() ? a.size() > b.size() : a < b;
    }
};

// What was typed, by what std::filesystem has. Folders end with a slash.
std::map<std::string, std::string, LongerFirst>& words()
{
    static std::map<std::string, std::string, LongerFirst> all;
    return all;
}

// Whether a name may begin at this character of a text.
bool mayBegin(const std::string& text, std::size_t at)
{
    return at == 0 || std::string_view(" \n\"'(=").find(text[at - 1]) != std::string_view::npos;
}

// Replaces a part of a text, and the slashes in the rest of the name. Returns where the name ends.
std::size_t replaceName(std::string& text, std::size_t at, std::size_t size, const std::string& word, bool json)
{
    const std::size_t end = std::min(text.find_first_of(" \n\",:\\", at + size), text.size());
    std::string rest = text.substr(at + size, end - at - size), name;
    std::ranges::replace(rest, '/', '\\');
    for (const char c : word + rest)
        name += c == '\\' && json ? "\\\\" : std::string(1, c);
    text.replace(at, end - at, name);
    return at + name.size();
}

} // namespace

std::string fileOfWord(const std::string& word)
{
    if (!systemFileOf)
        return word;
    std::string file = systemFileOf(word);
    if (file == word)
        return file;
    words()[file] = word;
    // The folders of the file, as far as the word names them.
    for (std::size_t left = 0; left < std::min(file.size(), word.size()); ++left) {
        const std::size_t ofFile = file.size() - left, ofWord = word.size() - left;
        const char c = file[ofFile - 1], typed = word[ofWord - 1];
        if (c != typed && !(c == '/' && typed == '\\'))
            break;
        if (c == '/' && file.find_first_not_of('/') < ofFile)
            words()[file.substr(0, ofFile)] = word.substr(0, ofWord);
    }
    return file;
}

std::string asTyped(std::string text, bool json)
{
    if (!systemFileOf)
        return text;
    for (const auto& [file, word] : words())
        for (std::size_t at = 0; (at = text.find(file, at)) != std::string::npos;)
            at = mayBegin(text, at) ? replaceName(text, at, file.size(), word, json) : at + 1;
    // A whole name of a drive that nobody typed: /C:/folder.
    for (std::size_t at = 0; (at = text.find(":/", at)) != std::string::npos; ++at)
        if (at > 1 && text[at - 2] == '/' && isLetter(text[at - 1]) && mayBegin(text, at - 2))
            replaceName(text, at - 2, 4, {text[at - 1], ':', '\\'}, json);
    return text;
}

} // namespace cotan::app
