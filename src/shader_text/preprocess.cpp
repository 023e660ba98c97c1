#include <sstream>

#include "parse.hpp"

namespace cotan::shader_text {

namespace {

// The macro asked for in "#if defined(NAME)", "#elif defined(NAME)".
std::string askedFor(const std::string& line)
{
    const std::size_t open = line.find('('), close = line.find(')');
    return open == std::string::npos || close == std::string::npos ? std::string()
                                                                   : line.substr(open + 1, close - open - 1);
}

bool startsWith(const std::string& line, const char* start) { return line.rfind(start, 0) == 0; }

struct Branch {
    bool active = false; // this branch is read
    bool taken = false;  // one branch of the chain was
};

} // namespace

Preprocessed preprocess(std::string_view text, std::string_view language)
{
    Preprocessed result;
    std::vector<Branch> branches;
    auto active = [&] {
        for (const Branch& b : branches)
            if (!b.active)
                return false;
        return true;
    };
    std::istringstream stream{std::string(text)};
    for (std::string line; std::getline(stream, line);) {
        if (startsWith(line, "#ifndef")) {
            branches.push_back({true, true}); // include guards
        } else if (startsWith(line, "#if ")) {
            const bool chosen = askedFor(line) == language;
            branches.push_back({chosen, chosen});
        } else if (startsWith(line, "#elif")) {
            const bool chosen = !branches.back().taken && askedFor(line) == language;
            branches.back().active = chosen;
            branches.back().taken |= chosen;
        } else if (startsWith(line, "#else")) {
            branches.back().active = !branches.back().taken;
        } else if (startsWith(line, "#endif")) {
            branches.pop_back();
        } else if (!active() || startsWith(line, "#error")) {
            continue;
        } else if (startsWith(line, "#define")) {
            std::istringstream words(line.substr(0, line.find("//")));
            std::string define, name, value, rest;
            words >> define >> name;
            std::getline(words >> std::ws, value);
            // The others (cotan_vec3 and so on) are the language's names for things: print.cpp's affair.
            if (startsWith(name, "COTAN_") && !value.empty() && name != "COTAN_FUNCTION")
                result.constants[name] = value;
            result.text += '\n';
        } else {
            result.text += line + '\n';
        }
    }
    return result;
}

} // namespace cotan::shader_text
