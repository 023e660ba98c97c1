// Every choice of `cotan shader`: makes the same text twice, with its entry point and balanced brackets.
#include <algorithm>

#include "cotan/shader_text.hpp"
#include "fuzz.hpp"

using namespace cotan;
using namespace cotan::fuzz;
using shader_text::Choice;
using shader_text::Form;

namespace {

Choice choiceOf(Values values)
{
    Choice choice;
    choice.language = shader_text::kLanguages[values.choose(int(std::size(shader_text::kLanguages)))];
    choice.frame = Frame(values.choose(kFrameCount));
    const auto presets = conventionPresets();
    if (const int preset = values.choose(int(presets.size()) + 1); preset > 0)
        choice.convention = presets[std::size_t(preset - 1)].convention;
    if (values.flip())
        choice.convention.channels = Channels(values.choose(4));
    if (values.flip())
        choice.convention.expansion = Expansion(values.choose(3));
    choice.convention.greenUp = values.flip();
    choice.convention.v = values.flip() ? VDirection::up : VDirection::down;
    if (const int form = values.choose(3); form > 0)
        choice.form = form == 1 ? Form::fused : Form::total;
    choice.uvSets = values.next<std::int8_t>();
    choice.callerDifferences = values.flip();
    choice.functionsOnly = values.flip();
    choice.twoSided = values.flip();
    for (const shader_text::Set set : shader_text::kSets)
        if (values.flip())
            choice.sets.push_back(set);
    return choice;
}

void checkBrackets(const std::string& text)
{
    std::string open;
    bool comment = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        comment = text[i] != '\n' && (comment || text.compare(i, 2, "//") == 0);
        const std::size_t which = comment ? std::string::npos : std::string("([{").find(text[i]);
        if (which != std::string::npos)
            open += ")]}"[which];
        if (!comment && std::string(")]}").find(text[i]) != std::string::npos) {
            COTAN_HOLDS(!open.empty() && open.back() == text[i], "{}", text.substr(0, i + 1));
            open.pop_back();
        }
    }
    COTAN_HOLDS(open.empty(), "{}", text);
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const Choice choice = choiceOf(Values({data, size}));
    const auto text = makeShaderText(choice);
    if (!text) {
        checkError(text.error());
        COTAN_HOLDS(text.error().kind == ErrorKind::usage);
        return 0;
    }
    COTAN_HOLDS(choice.uvSets >= 1 && choice.uvSets <= 4, "{}", choice.uvSets);
    COTAN_HOLDS(text->text.find(text->entry + "(") != std::string::npos, "{}", text->entry);
    COTAN_HOLDS(std::ranges::find(text->functions, text->entry) != text->functions.end(), "{}", text->entry);
    // Names of the portable text must not remain, except that C++ keeps its type names.
    for (const char* const leftover : {"COTAN_", "cotan_normal_format", "cotan_real", "cotan_vec3"})
        COTAN_HOLDS((choice.language == shader_text::Language::cpp && leftover[0] == 'c')
                        || text->text.find(leftover) == std::string::npos,
                    "{}", leftover);
    checkBrackets(text->text);
    COTAN_HOLDS(makeShaderText(choice)->text == text->text, "the second text differs");
    return 0;
}
