// cotan.h: shader text.
#include "cotan/shader_text.hpp"

#include "call.hpp"

using namespace cotan;
using namespace cotan::c;

cotan_status cotan_shader_text(const char* language, const char* frame, const char* convention, char* text,
                               size_t* text_size, char* message, size_t message_size)
{
    return call(message, message_size, [&] {
        require(text_size, "text_size: expected a pointer, found null");
        shader_text::Choice choice;
        const auto known = shader_text::languageFromName(word(language, "language"));
        if (!known)
            fail(ErrorKind::usage, "language: expected ", shader_text::languageNames(), ", found '", language, "'");
        choice.language = *known;
        const std::string_view words = frame ? frame : "", name = words.substr(0, words.find(','));
        if (words.empty())
            choice.frame = valueOf(shader_text::frameIfNoneIsNamed(*known));
        else if (const auto which = frameFromName(name))
            choice.frame = *which;
        else
            fail(ErrorKind::usage, "frame: expected a frame, found '", name, "'");
        if (name.size() < words.size()) { // "triangle,vertex": a comma, then the stage
            const std::string_view stage = words.substr(name.size() + 1);
            const auto wanted = shader_text::stageFromName(stage);
            if (!wanted)
                fail(ErrorKind::usage, "stage: expected fragment, vertex, mesh or compute, found '", stage, "'");
            choice.stage = *wanted;
        }
        choice.convention = valueOf(parseSampledConvention(word(convention, "convention")), "convention");
        const shader_text::ShaderText made = valueOf(shader_text::makeShaderText(choice), "shader");
        const std::size_t needed = made.text.size() + 1;
        if (text && *text_size >= needed)
            std::memcpy(text, made.text.c_str(), needed);
        *text_size = needed;
    });
}
