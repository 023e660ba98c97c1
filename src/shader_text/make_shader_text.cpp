#include "cotan/shader_text.hpp"

#include <algorithm>
#include <set>

#include "core/try.hpp"
#include "entry.hpp"
#include "languages.hpp"

namespace cotan::shader_text {

namespace {

// Parses the whole portable text, followed by `extra`.
Module parseAll(Language language, std::string_view extra)
{
    Module module;
    std::map<std::string, Expression> constants;
    const std::string_view branch = infoOf(language).branch;
    for (const PortablePart& part : portableParts())
        parsePart(module, constants, part.name, part.text, branch);
    parsePart(module, constants, "entry", extra, branch);
    return module;
}

// Specialises cotan_decode for one convention.
void bindConvention(Module& module, const Convention& c)
{
    bindArgument(module, "cotan_decode", "format", "expansion", std::to_string(int(c.expansion)));
    bindArgument(module, "cotan_decode", "format", "channels", std::to_string(int(c.channels)));
    bindArgument(module, "cotan_decode", "format", "green", greenAlongV(c) ? "1.0" : "-1.0");
    bindArgument(module, "cotan_decode", "format", "strength", "1.0");
    bindArgument(module, "cotan_expand", "expansion", "", std::to_string(int(c.expansion)));
    for (Function& f : module.functions) {
        if (f.name == "cotan_expand") {
            f.comments = {"// The signed value of a stored component, in [-1,1]."};
        } else if (f.name == "cotan_decode") {
            f.comments = {"// The decoded texel: normal along (+u, +v, outwards). Not unit in general.",
                          "// texel: as sampled; two-channel maps use x and y only."};
            std::erase_if(f.parameters, [](const Variable& p) { return p.name == "format"; }); // all fields are bound
        } else {
            continue;
        }
        simplify(f);
    }
}

std::vector<std::string> rootsOf(const Module& module, const Choice& choice)
{
    std::set<std::string_view> parts = {"entry"};
    std::vector<std::string> roots;
    for (const Set set : choice.sets) {
        if (set == Set::light && isGodotShader(choice)) {
            for (std::string& function : functionsOfLight())
                roots.push_back(std::move(function));
            continue;
        }
        parts.insert(name(set));
        if (set == Set::light)
            parts.insert("sheen");
        if (set == Set::parallax)
            roots.push_back("cotan_frame_gradient"); // which it needs, whatever frame lights the map
    }
    for (const Function& f : module.functions)
        if (parts.contains(f.part))
            roots.push_back(f.name);
    return roots;
}

Result<Form> formOf(const Choice& choice)
{
    const bool several = choice.uvSets > 1;
    if (choice.uvSets < 1 || choice.uvSets > 4)
        return usageError(fill("uv sets: expected 1 to 4; found {}", choice.uvSets));
    if (several && info(choice.frame).source != FrameSource::differences)
        return usageError(
            fill("several uv sets: expected a frame made from differences; found '{}'", name(choice.frame)));
    if ((choice.form == Form::seen || choice.form == Form::area)
        && (several || choice.frame != Frame::cotangent || choice.language == Language::godot))
        return usageError(fill("the form {}: expected the frame cotangent over one uv set in another language than "
                               "Godot's; found the frame {}, {} uv sets, {}",
                               name(*choice.form), name(choice.frame), choice.uvSets, name(choice.language)));
    const bool hasFused = several ? choice.frame == Frame::cotangent : hasFusedForm(choice.frame);
    if (choice.form == Form::fused && !hasFused)
        return usageError(
            several ? fill("the fused form over several uv sets: expected cotangent; found '{}'", name(choice.frame))
                    : fill("the fused form: expected {}; found '{}'", fusedFrameNames(" or "), name(choice.frame)));
    const bool fusedByItself = hasFused && !readsVertices(choice.frame);
    const Form form = choice.form ? *choice.form : fusedByItself ? Form::fused : Form::total;
    if (choice.stage != Stage::all && (!readsTriangleVectors(choice.frame) || form != Form::fused))
        return usageError("a stage: expected the frame triangle in its fused form; found another");
    for (const Set set : choice.sets)
        if (!hasSet(choice.language, set))
            return usageError(
                fill("the set {}: Godot does this itself; expected gradient, blend, space, mapping, parallax or light",
                     name(set)));
    const Status possible = choice.language == Language::godot ? checkGodot(choice, form) : Done{};
    return possible ? Result<Form>(form) : possible.error();
}

} // namespace

std::string_view name(Set set)
{
    constexpr std::string_view kSetNames[] = {"gradient", "blend",       "space", "mapping", "parallax",
                                              "light",    "environment", "tone",  "shadow"};
    return kSetNames[int(set)];
}

std::string_view name(Form form)
{
    constexpr std::string_view kFormNames[] = {"fused", "total", "seen", "area"};
    return kFormNames[int(form)];
}

bool hasSet(Language language, Set set)
{
    return language != Language::godot || (set != Set::environment && set != Set::tone && set != Set::shadow);
}

bool hasFusedForm(Frame frame) { return info(frame).fused; }

Result<Frame> frameIfNoneIsNamed(Language language)
{
    if (language == Language::godot)
        return Frame::orthonormal;
    std::string text = "frame: expected ";
    for (const FrameAdvice& advice : kFrameAdvice)
        text += fill("{} {}; ", advice.frames, advice.maps);
    return usageError(text + "found none");
}

std::string fusedFrameNames(std::string_view beforeLast)
{
    std::vector<std::string_view> names;
    for (const FrameInfo& f : frames())
        if (f.fused)
            names.push_back(f.name);
    std::ranges::sort(names);
    std::string text(names.front());
    for (std::size_t i = 1; i < names.size(); ++i)
        text += std::string(i + 1 < names.size() ? ", " : beforeLast) + std::string(names[i]);
    return text;
}

Result<ShaderText> makeShaderText(const Choice& choice)
{
    COTAN_TRY(form, formOf(choice));
    Module module = parseAll(choice.language, entryText(choice, *form));
    bindConvention(module, choice.convention);
    const Module needed = neededBy(module, rootsOf(module, choice));
    ShaderText result;
    result.form = *form;
    result.entry = entryOf(choice);
    for (const Function& f : needed.functions)
        result.functions.push_back(f.name);
    const std::string functions = print(needed, choice.language);
    result.text = introduction(choice, *form) + (isGodotShader(choice) ? godotShader(choice, functions) : functions);
    return result;
}

std::string translate(Language language, std::string_view extra)
{
    const Module module = parseAll(language, extra);
    return print(neededBy(module, rootsOf(module, {})), language);
}

} // namespace cotan::shader_text
