#include "commands.hpp"

#include <fmt/format.h>

#include "cotan/files/output.hpp"
#include "cotan/shader_text/shader_text.hpp"
#include "parse.hpp"

namespace cotan::app {

namespace {

using shader_text::Choice;
using shader_text::Form;

struct ShaderCommandOptions {
    CommonOptions common;
    std::string language;
    std::string frame = "cotangent";
    std::string form;
    std::string preset, channels, green, expansion;
    std::vector<std::string> sets;
    std::string differences = "shader";
    int uvSets = 1;
};

template<class Value>
using Words = std::vector<std::pair<std::string_view, Value>>;

// The value of a word; the error lists all words.
template<class Value>
Result<Value> valueOf(std::string_view option, const std::string& word, const Words<Value>& words)
{
    std::string known;
    for (const auto& [name, value] : words) {
        if (name == word)
            return value;
        known += (known.empty() ? "" : ", ") + std::string(name);
    }
    return usageError(fmt::format("{}: expected one of {}; found '{}'", option, known, word));
}

Result<Convention> conventionOf(const ShaderCommandOptions& o)
{
    Words<Convention> presets{{"", Convention{}}};
    for (const ConventionPreset& p : conventionPresets())
        presets.push_back({p.name, p.convention});
    if (!o.preset.empty())
        presets.erase(presets.begin());
    Result<Convention> c = valueOf("--preset", o.preset, presets);
    if (!c)
        return c;
    if (!o.channels.empty()) {
        const Result<Channels> channels = valueOf<Channels>("--channels", o.channels,
                                                            {{"3", Channels::xyz},
                                                             {"2", Channels::orthographic},
                                                             {"stereographic", Channels::stereographic},
                                                             {"slope", Channels::slope}});
        if (!channels)
            return channels.error();
        c->channels = *channels;
    }
    if (!o.expansion.empty()) {
        const Result<Expansion> expansion = valueOf<Expansion>("--unsigned", o.expansion,
                                                               {{"exact", Expansion::exact},
                                                                {"exact16", Expansion::exact16},
                                                                {"biased", Expansion::biased},
                                                                {"signed", Expansion::signedValues}});
        if (!expansion)
            return expansion.error();
        c->expansion = *expansion;
    }
    if (!o.green.empty()) {
        const Result<bool> along = valueOf<bool>("--green", o.green, {{"along-v", true}, {"against-v", false}});
        if (!along)
            return along.error();
        c->v = VDirection::up;
        c->greenUp = *along;
    }
    return c;
}

Result<Choice> choiceOf(const ShaderCommandOptions& o)
{
    Choice choice;
    Words<shader_text::Language> languages;
    for (shader_text::Language l : shader_text::kLanguages)
        languages.push_back({name(l), l});
    const auto language = valueOf("--lang", o.language, languages);
    if (!language)
        return language.error();
    choice.language = *language;
    const Result<Frame> frame = parseFrame(o.frame);
    if (!frame)
        return usageError(frame.error().message);
    choice.frame = *frame;
    const Result<Convention> convention = conventionOf(o);
    if (!convention)
        return convention.error();
    choice.convention = *convention;
    if (!o.form.empty()) {
        const Result<Form> form = valueOf<Form>(
            "--form", o.form, {{"fused", Form::fused}, {"total", Form::total}, {"readable", Form::total}});
        if (!form)
            return form.error();
        choice.form = *form;
    }
    const Result<bool> caller =
        valueOf<bool>("--differences", o.differences, {{"shader", false}, {"caller", true}});
    if (!caller)
        return caller.error();
    choice.callerDifferences = *caller;
    choice.uvSets = o.uvSets;
    for (const std::string& set : o.sets) {
        const Result<int> which = valueOf<int>(
            "--set", set, {{"frame", 0}, {"gradient", 1}, {"blend", 2}, {"light", 4}, {"all", 7}});
        if (!which)
            return which.error();
        choice.gradients |= (*which & 1) != 0;
        choice.blends |= (*which & 2) != 0;
        choice.lights |= (*which & 4) != 0;
    }
    return choice;
}

Status run(const ShaderCommandOptions& o)
{
    const Result<Choice> choice = choiceOf(o);
    if (!choice)
        return choice.error();
    if (Status planned = planOutputs(o.common, {{"-o", o.common.output}}); !planned)
        return planned;
    const Result<shader_text::ShaderText> text = makeShaderText(*choice);
    if (!text)
        return text.error();
    if (!o.common.output.empty()) {
        if (Status written = writeFileWhole(o.common.output, text->text); !written)
            return written;
    } else if (o.common.json != "-") {
        print(text->text);
    }
    nlohmann::ordered_json report;
    report["language"] = name(choice->language);
    report["frame"] = name(choice->frame);
    report["form"] = text->form == Form::fused ? "fused" : "total";
    report["normal_map"] = describe(choice->convention);
    report["green_along_v"] = greenAlongV(choice->convention);
    report["uv_sets"] = choice->uvSets;
    report["entry"] = text->entry;
    report["functions"] = text->functions;
    return writeReport(o.common, report);
}

} // namespace

Command addShaderCommand(CLI::App& app)
{
    auto o = std::make_shared<ShaderCommandOptions>();
    CLI::App* command = app.add_subcommand("shader", "the text of a frame for your shader, self-contained");
    addCommonOptions(*command, o->common, "file for the text instead of standard output");
    command->get_option("--threads")->group(""); // accepted by all commands, listed where it is used
    command->add_option("--lang", o->language, "glsl, essl, hlsl, wgsl, msl or cpp")->required()->type_name("NAME");
    command->add_option("--frame", o->frame, "one of " + frameNames())->type_name("NAME")->capture_default_str();
    command
        ->add_option("--form", o->form,
                     "fused: frame and texel in one step (" + shader_text::fusedFrameNames() + "); total: the frame as "
                     "three covectors, for any input; readable: another word for total. Default: fused where there is one")
        ->type_name("NAME");
    command
        ->add_option("--preset", o->preset,
                     "how the normal map is stored: gltf, opengl, directx, unity, unreal, blender, godot, maya, "
                     "3dsmax, source; the next three options replace parts of it. Default: 3 channels, green against "
                     "v, exact")
        ->type_name("NAME");
    command->add_option("--channels", o->channels, "3, 2 (z from the other two), stereographic or slope")->type_name("N");
    command->add_option("--green", o->green, "along-v or against-v: where green points")->type_name("WAY");
    command
        ->add_option("--unsigned", o->expansion,
                     "exact, (255c - 128)/127; exact16, the same for maps of 16 bits; biased, 2c - 1; signed, as sampled")
        ->type_name("NAME");
    command->add_option("--uv-sets", o->uvSets, "normal maps over uv sets of their own, 1 to 4, added as gradients")
        ->type_name("N")
        ->capture_default_str();
    command
        ->add_option("--set", o->sets, "more functions: gradient, blend, light, all")
        ->delimiter(',')
        ->type_name("A,B");
    command
        ->add_option("--differences", o->differences,
                     "shader: also a function that takes the screen derivatives itself; caller: not (for compute, "
                     "ray tracing, vertex stages)")
        ->type_name("WHO")
        ->capture_default_str();
    addExamples(*command, {"cotan shader --lang wgsl -o normal.wgsl",
                           "cotan shader --lang glsl --preset unity --set blend,light"});
    return {command, [o] { return run(*o); }};
}

} // namespace cotan::app
