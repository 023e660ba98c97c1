// The manual page of a made-up command, against hand-written text in the form that man(7) requires.
#include <gtest/gtest.h>

#include "help/help_files.hpp"

namespace cotan {

using namespace app;
namespace {

OptionHelp option(HelpGroup group, std::vector<std::string> names, std::string value, std::string help)
{
    OptionHelp o;
    o.group = group;
    o.names = std::move(names);
    o.value = std::move(value);
    o.help = std::move(help);
    return o;
}

CommandHelp commandOf(std::string name, std::string summary)
{
    CommandHelp c;
    c.name = std::move(name);
    c.summary = std::move(summary);
    return c;
}

CommandHelp madeUp()
{
    OptionHelp model = option(HelpGroup::input, {"MODEL"}, "MODEL", "glTF file");
    model.positional = model.required = true;
    OptionHelp extra = option(HelpGroup::input, {"EXTRA"}, "EXTRA", "another file");
    extra.positional = true;
    OptionHelp output = option(HelpGroup::output, {"-o", "--output"}, "FILE", "image");
    output.required = true;
    OptionHelp gloss = option(HelpGroup::look, {"--gloss"}, "X", "how glossy, as --matt");
    gloss.usual = "0.5";
    gloss.minimum = "0";
    gloss.maximum = "1";
    OptionHelp tone = option(HelpGroup::look, {"--tone"}, "NAME", "curve, none by default");
    tone.words = {"none", "aces"};
    tone.closed = true;
    OptionHelp all = option(HelpGroup::look, {"--all"}, "", "red and blue");
    all.words = {"red", "blue"};
    all.closed = true;
    OptionHelp lamp = option(HelpGroup::look, {"--lamp"}, "NAME", "lamp");
    lamp.repeated = true;
    CommandHelp paint = commandOf("paint", "Paint a model.");
    paint.heading = "Painting";
    paint.options = {model, extra, output, gloss, tone, all, lamp};
    paint.examples = {"tool paint a.glb -o b.png"};
    paint.closing = "Exit codes: 0 good, 1 usage.";
    return paint;
}

TEST(ManPage, hasEverySectionOfACommand)
{
    const CommandHelp paint = madeUp();
    CommandHelp tool = commandOf("tool", "Draw things.");
    tool.commands = {paint};
    EXPECT_EQ(
        manPage({&tool, &paint}, "1.2"),
        ".\\\" Made from the same table as \"tool paint --help\".\n"
        ".TH TOOL\\-PAINT 1 \"\" \"tool 1.2\" \"User Commands\"\n.nh\n.ad l\n"
        ".SH NAME\ntool\\-paint \\- paint a model\n"
        ".SH SYNOPSIS\n\\fBtool paint\\fR \\fIMODEL\\fR [\\fIEXTRA\\fR] \\fB\\-o\\fR \\fIFILE\\fR [\\fIOPTIONS\\fR]\n"
        ".SH ARGUMENTS\n.TP\n\\fIMODEL\\fR\nglTF file.\n.TP\n\\fIEXTRA\\fR\nAnother file.\n"
        ".SH OPTIONS\n"
        ".SS Output\n.TP\n\\fB\\-o\\fR, \\fB\\-\\-output\\fR \\fIFILE\\fR\nImage. Required.\n"
        ".SS Look\n"
        ".TP\n\\fB\\-\\-gloss\\fR \\fIX\\fR\nHow glossy, as \\-\\-matt. From 0 to 1. Default: 0.5.\n"
        ".TP\n\\fB\\-\\-tone\\fR \\fINAME\\fR\nCurve, none by default. Words: none, aces.\n"
        ".TP\n\\fB\\-\\-all\\fR\nRed and blue.\n"
        ".TP\n\\fB\\-\\-lamp\\fR \\fINAME\\fR\nLamp. May be given several times.\n"
        ".SH EXAMPLES\n.PP\n.EX\ntool paint a.glb \\-o b.png\n.EE\n"
        ".SH \"EXIT STATUS\"\n0 good, 1 usage.\n"
        ".SH \"SEE ALSO\"\n\\fBtool\\fR(1)\n");
}

TEST(ManPage, toolPageListsThePagesOfItsCommands)
{
    CommandHelp tool = commandOf("tool", "Draw things.");
    tool.commands = {madeUp(), commandOf("wash", "clean")};
    tool.commands[1].heading = "Painting";
    const std::string page = manPage({&tool}, "1.2");
    EXPECT_NE(page.find(".SH SYNOPSIS\n\\fBtool\\fR \\fICOMMAND\\fR [\\fIOPTIONS\\fR]\n"), std::string::npos) << page;
    EXPECT_NE(page.find(".SH COMMANDS\nEach has a page of its own.\n.SS \"Painting\"\n"
                        ".TP\n\\fBtool\\-paint\\fR(1)\nPaint a model.\n.TP\n\\fBtool\\-wash\\fR(1)\nClean.\n"),
              std::string::npos)
        << page;
    EXPECT_EQ(page.find("SEE ALSO"), std::string::npos);
    EXPECT_EQ(page.find("ARGUMENTS"), std::string::npos);
}

} // namespace
} // namespace cotan
