#include "commands.hpp"

#include <fmt/format.h>

#include "core/try.hpp"
#include "cotan/shader_text.hpp"
#include "files/output.hpp"
#include "parse.hpp"

namespace cotan::app {

namespace {

using shader_text::Choice;
using shader_text::Form;

struct ShaderCommandOptions : CommonOptions {
    std::string language;
    std::string frame; // empty: depends on the language
    std::string form, stage;
    std::string preset, channels, green, expansion;
    std::vector<std::string> sets;
    std::string differences = "shader";
    int uvSets = 1;
    bool functions = false, twoSided = false;
};

Result<Convention> conventionOf(const ShaderCommandOptions& o)
{
    Convention c;
    Words<Convention> presets;
    for (const ConventionPreset& p : conventionPresets())
        presets.push_back({p.name, onGpu(p)});
    if (o.language == "godot") // its importer may drop blue; code that reads it would fail silently
        c.channels = Channels::orthographic;
    COTAN_CHECK(choose(c, "--preset", o.preset, presets));
    COTAN_CHECK(choose(c.channels, "--channels", o.channels,
                       {{"3", Channels::xyz},
                        {"2", Channels::orthographic},
                        {"stereographic", Channels::stereographic},
                        {"slope", Channels::slope}}));
    COTAN_CHECK(choose(c.expansion, "--unsigned", o.expansion,
                       {{"exact", Expansion::exact},
                        {"exact16", Expansion::exact16},
                        {"biased", Expansion::biased},
                        {"signed", Expansion::signedValues}}));
    COTAN_CHECK(choose(c.greenUp, "--green", o.green, {{"along-v", true}, {"against-v", false}}));
    if (!o.green.empty())
        c.v = VDirection::up;
    return c;
}

Status chooseText(const ShaderCommandOptions& o, Choice& choice)
{
    Words<shader_text::Language> languages;
    for (shader_text::Language l : shader_text::kLanguages)
        languages.push_back({name(l), l});
    COTAN_CHECK(choose(choice.language, "--lang", o.language, languages));
    Words<std::optional<Form>> forms;
    for (const Form f : shader_text::kForms) {
        forms.push_back({name(f), f});
        if (f == Form::total)
            forms.push_back({"readable", f});
    }
    COTAN_CHECK(choose(choice.form, "--form", o.form, forms));
    Words<shader_text::Stage> stages;
    for (shader_text::Stage s : shader_text::kStages)
        stages.push_back({name(s), s});
    COTAN_CHECK(choose(choice.stage, "--stage", o.stage, stages));
    return choose(choice.callerDifferences, "--differences", o.differences, {{"shader", false}, {"caller", true}});
}

// The error for a missing --frame, with a line for each case.
Error withoutFrame()
{
    Error error = usageError("--frame: expected the frame that the normal map was baked for; found none");
    for (const shader_text::FrameAdvice& advice : shader_text::kFrameAdvice)
        error.advice += fmt::format("  --frame {}: {}\n", advice.frames, advice.maps);
    return error;
}

Result<Choice> choiceOf(const ShaderCommandOptions& o)
{
    Choice choice;
    COTAN_CHECK(chooseText(o, choice));
    std::string wanted = o.frame;
    if (wanted.empty()) {
        const auto usual = shader_text::frameIfNoneIsNamed(choice.language);
        if (!usual)
            return withoutFrame();
        wanted = name(*usual);
    }
    // The cost tables list these forms of `cotangent` like frames.
    for (const Form form : {Form::seen, Form::area})
        if (wanted == "cotangent-" + std::string(name(form)) && (!choice.form || choice.form == form)) {
            choice.form = form;
            wanted = name(Frame::cotangent);
        }
    COTAN_TRY(frame, parseFrame(wanted, "--frame"));
    choice.frame = *frame;
    COTAN_TRY(convention, conventionOf(o));
    choice.convention = *convention;
    choice.uvSets = o.uvSets;
    if (o.functions && choice.language != shader_text::Language::godot)
        return usageError("--functions: only for --lang godot; the other languages have nothing but functions");
    if (o.twoSided && (choice.language != shader_text::Language::godot || o.functions))
        return usageError("--two-sided: only for a whole shader of --lang godot; functions work for both sides");
    choice.functionsOnly = o.functions;
    choice.twoSided = o.twoSided;
    Words<std::vector<shader_text::Set>> sets{{"frame", {}}};
    std::vector<shader_text::Set> all;
    for (const shader_text::Set set : shader_text::kSets) {
        sets.push_back({name(set), {set}});
        if (hasSet(choice.language, set))
            all.push_back(set);
    }
    sets.push_back({"all", all});
    for (const std::string& word : o.sets) {
        COTAN_TRY(chosen, oneOf("--set", word, sets));
        choice.sets.insert(choice.sets.end(), chosen->begin(), chosen->end());
    }
    return choice;
}

Status run(const ShaderCommandOptions& o)
{
    COTAN_TRY(choice, choiceOf(o));
    COTAN_CHECK(beginOutputs(o, {{"-o", o.output}}));
    COTAN_TRY(text, makeShaderText(*choice));
    if (!o.output.empty()) {
        COTAN_CHECK(writeFileWhole(o.output, text->text));
    } else if (o.json != "-") {
        print(text->text);
    }
    Json report = {{"command", "shader"}};
    report["language"] = name(choice->language);
    report["frame"] = name(choice->frame);
    report["form"] = name(text->form);
    report["normal_map"] = describe(choice->convention);
    report["green_along_v"] = greenAlongV(choice->convention);
    report["uv_sets"] = choice->uvSets;
    report["entry"] = text->entry;
    report["functions"] = text->functions;
    return writeReport(o, report);
}

void declare(Arguments& a, ShaderCommandOptions& o)
{
    a.find("--threads").unlisted(); // accepted by all commands, but listed only where used
    a.option("--lang", o.language, shader_text::languageNames() + "; godot is a whole spatial shader")
        .required()
        .in("NAME")
        .main();
    a.option("--frame", o.frame,
             "frame to print: " + usefulFrameNames()
                 + ", or a historical one of --list-frames; required, except for --lang godot (orthonormal)")
        .in("NAME")
        .offers(frameWords())
        .main();
    addListOfFrames(a);
    a.option(
         "--form", o.form,
         "fused: frame and texel in one step (cotangent, gradient, orthonormal, smooth, triangle); total: the frame as "
         "three covectors, for any input; readable: another name for total; for cotangent also seen (the cheapest: the "
         "normal faces the viewer; a constant gives the image orientation) and area (for square texels). Default: "
         "fused where available, except for smooth")
        .in("NAME")
        .offers({"fused", "total", "readable", "seen", "area"});
    a.option("--stage", o.stage,
             "for the frame triangle: fragment, the code per pixel; vertex or mesh, the code that makes the "
             "triangle's two vectors; compute, both in one. Default: all")
        .in("NAME")
        .offers({"fragment", "vertex", "mesh", "compute"});
    a.group(HelpGroup::input);
    a.option("--preset", o.preset,
             "how the normal map is sampled: gltf, opengl, directx, unity, unreal, blender, godot, maya, "
             "3dsmax, source; unity, unreal and godot keep two channels of the imported file; "
             "these, gltf and blender are biased. The next three options replace parts of it. Default: 3 channels, "
             "for --lang godot 2; green against v, exact")
        .in("NAME")
        .offers(presetWords())
        .main();
    a.option("--channels", o.channels, "3, 2 (z from the other two), stereographic or slope")
        .in("N")
        .offers({"3", "2", "stereographic", "slope"});
    a.option("--green", o.green, "where green points: along-v or against-v").in("WAY").offers({"along-v", "against-v"});
    a.option("--unsigned", o.expansion,
             "how a stored value c becomes a number: exact, (255c - 128)/127; exact16, the same for maps of 16 bits; "
             "biased, 2c - 1; signed, as sampled")
        .in("NAME")
        .offers({"exact", "exact16", "biased", "signed"});
    a.option("--uv-sets", o.uvSets,
             "number of normal maps, 1 to 4, each with its own uv set; they are added as gradients")
        .in("N");
    a.group(HelpGroup::output);
    a.option("--set", o.sets,
             "more functions: gradient, blend, space, mapping, parallax, light, environment, tone, shadow, all")
        .separatedByCommas()
        .in("A,B")
        .main();
    a.flag("--functions", o.functions,
           "Godot: the functions alone, to paste or as a .gdshaderinc, without shader_type, the map and fragment()");
    a.flag("--two-sided", o.twoSided, "Godot: draw back faces, as of a thin sheet: a bump in front is a dent behind");
    a.option("--differences", o.differences,
             "shader: with a function that takes the screen derivatives itself; caller: without it, for compute, ray "
             "tracing and vertex stages, and for Godot's driver GLES2")
        .in("WHO")
        .offers({"shader", "caller"});
    std::vector<std::string> languages, sets = {"all"};
    for (const shader_text::Language l : shader_text::kLanguages)
        languages.emplace_back(name(l));
    for (const shader_text::Set set : shader_text::kSets)
        sets.emplace_back(name(set));
    a.find("--lang").offers(std::move(languages));
    a.find("--set").offers(std::move(sets));
}

} // namespace

void addShaderCommand(Arguments& tool)
{
    addCommand<ShaderCommandOptions>(tool,
                                     {"shader",
                                      "Print self-contained shader code that applies a normal map.",
                                      "file for the text instead of standard output",
                                      {"cotan shader --lang wgsl --frame orthonormal -o normal.wgsl",
                                       "cotan shader --lang glsl --frame smooth --preset unity --set blend,light"}},
                                     declare, run);
}

} // namespace cotan::app
