// The text of --help, line by line, on both sides of every width; nested commands; suggestions for misspelt options.
#include <gtest/gtest.h>

#include "terminal/arguments.hpp"
#include "terminal/command_walk.hpp"
#include "terminal/help_text.hpp"
#include "terminal/printable.hpp"

namespace cotan {

using namespace app;
namespace {

OptionHelp optionOf(HelpGroup group, std::vector<std::string> names, const std::string& value, const std::string& help)
{
    OptionHelp option;
    option.group = group;
    option.names = std::move(names);
    option.value = value;
    option.help = help;
    return option;
}

// One option of each kind whose line just fits, and one that is a letter longer.
CommandHelp bake()
{
    CommandHelp command;
    command.name = "bake";
    command.summary = "Makes a map.";
    const std::string x(26, 'x'), y(27, 'y');
    OptionHelp model = optionOf(HelpGroup::main, {"MODEL"}, "MODEL", "a model");
    model.positional = model.required = true;
    OptionHelp more = optionOf(HelpGroup::main, {"MORE"}, "MORE", "others");
    more.positional = more.repeated = true;
    OptionHelp output = optionOf(HelpGroup::main, {"-o", "--output"}, "PATH", "where it goes");
    output.required = true;
    OptionHelp size = optionOf(HelpGroup::output, {"--size"}, "N", "texels a side");
    size.minimum = "1";
    size.maximum = "64";
    size.usual = "16";
    OptionHelp kind = optionOf(HelpGroup::output, {"--kind"}, "NAME", "flat or round");
    kind.words = {"flat", "round"};
    kind.closed = true;
    OptionHelp way = optionOf(HelpGroup::rays, {"--way"}, "NAME", "not round");
    way.words = {"round", "down"};
    way.closed = true;
    OptionHelp free = optionOf(HelpGroup::rays, {"--free"}, "NAME", "any");
    free.words = {"a", "b"}; // suggestions: other values are valid, too
    command.options = {model,
                       more,
                       output,
                       size,
                       kind,
                       way,
                       free,
                       optionOf(HelpGroup::rays, {"--" + std::string(20, 'a')}, "", x + " " + y),
                       optionOf(HelpGroup::rays, {"--" + std::string(21, 'b')}, "", x + " " + y + "y"),
                       optionOf(HelpGroup::general, {"--quiet"}, "", "")};
    command.examples = {"tool bake a.glb -o b.png", "tool bake " + std::string(80, 'c')};
    command.closing = "It ends with 0.";
    return command;
}

TEST(HelpText, hasEveryOptionInItsColumnAndWrapsAtTheWidth)
{
    CommandHelp tool;
    tool.name = "tool";
    const CommandHelp command = bake();
    const std::string x(26, 'x'), y(27, 'y'), column(26, ' ');
    const std::string begin = "Makes a map.\n\n"
                              "Usage: tool bake MODEL [MORE...] -o PATH [OPTIONS]\n"
                              "\nMain options:\n"
                              "  MODEL                   a model\n"
                              "  MORE                    others\n"
                              "  -o, --output PATH       where it goes (required)\n";
    const std::string end = "\nExamples:\n"
                            "  tool bake a.glb -o b.png\n"
                            "  tool bake "
        + std::string(80, 'c') + "\n\nIt ends with 0.\n";
    EXPECT_EQ(helpText({&tool, &command}, HelpLength::full, 80),
              begin
                  + "\nOutput:\n"
                    "  --size N                texels a side (1 to 64; default: 16)\n"
                    "  --kind NAME             flat or round\n"
                    "\nRays:\n"
                    "  --way NAME              not round (round, down)\n"
                    "  --free NAME             any\n"
                    "  --"
                  + std::string(20, 'a') + "  " + x + " " + y + "\n  --" + std::string(21, 'b') + "\n" + column + x
                  + "\n" + column + y + "y\n\nGeneral:\n  --quiet\n" + end);
    EXPECT_EQ(helpText({&tool, &command}, HelpLength::brief, 80),
              begin + "\n\"tool help bake\" shows 7 more options.\n" + end);
}

// Below 60 columns the text begins in the ninth; the minimum width is 40.
TEST(HelpText, isNarrowOnNarrowTerminals)
{
    CommandHelp tool;
    tool.name = "tool";
    CommandHelp command;
    command.name = "do";
    command.summary = "Does what it is asked to do, and no more.";
    command.options = {optionOf(HelpGroup::main, {"-x"}, "", "short"),
                       optionOf(HelpGroup::main, {"-a-b"}, "", "a word of some length and others behind"),
                       optionOf(HelpGroup::main, {"-a-bc"}, "", "next line")};
    const std::string narrow = "Does what it is asked to do, and no\n"
                               "more.\n\n"
                               "Usage: tool do [OPTIONS]\n"
                               "\nMain options:\n"
                               "  -x    short\n"
                               "  -a-b  a word of some length and others\n"
                               "        behind\n"
                               "  -a-bc\n"
                               "        next line\n";
    for (const std::size_t width : {0, 1, 39, 40})
        EXPECT_EQ(helpText({&tool, &command}, HelpLength::full, width), narrow) << width;
    EXPECT_NE(helpText({&tool, &command}, HelpLength::full, 59).find("  -x    short\n"), std::string::npos);
    EXPECT_NE(helpText({&tool, &command}, HelpLength::full, 60).find("  -x" + std::string(22, ' ') + "short\n"),
              std::string::npos);
}

TEST(HelpText, listsCommandsUnderTheirHeadings)
{
    CommandHelp tool, plain, more, last;
    tool.name = "tool";
    tool.summary = "All of it.";
    plain.name = "plain";
    plain.summary = "First.";
    more.name = "more";
    more.summary = "Second.";
    last.name = "last";
    more.heading = last.heading = "Others";
    tool.commands = {plain, more, last};
    tool.options = {optionOf(HelpGroup::general, {"--version"}, "", "print it")};
    EXPECT_EQ(helpText({&tool}, HelpLength::full, 80),
              "All of it.\n\nUsage: tool COMMAND [OPTIONS]\n"
              "\nCommands:\n  plain                   First.\n"
              "\nOthers:\n  more                    Second.\n  last\n"
              "\nGeneral:\n  --version               print it\n"
              "\n\"tool help COMMAND\" shows the options of a command.\n");
    CommandHelp inner = tool;
    inner.name = "map";
    const std::string brief = helpText({&tool, &inner}, HelpLength::brief, 80);
    EXPECT_NE(brief.find("\n\"tool help map COMMAND\" shows the options of a command.\n"), std::string::npos) << brief;
    EXPECT_EQ(brief.find("--version"), std::string::npos);
}

TEST(HelpText, placeholdersDetermineTheKindOfValue)
{
    for (const auto& [word, kind] : {std::pair("", ValueKind::none),
                                     {"PATH", ValueKind::file},
                                     {"FILE", ValueKind::file},
                                     {"NAME|FILE", ValueKind::file},
                                     {"FOLDER", ValueKind::folder},
                                     {"DIR", ValueKind::folder},
                                     {"A,B", ValueKind::list},
                                     {"WORDS", ValueKind::list},
                                     {"NAMES", ValueKind::list},
                                     {"NAME", ValueKind::word},
                                     {"N", ValueKind::word}})
        EXPECT_EQ(valueKind(word), kind) << word;
}

// Cut at the first pause after 20 letters, otherwise at the end of a word within 70.
TEST(HelpText, shortFormsOfSentencesEndAtAPause)
{
    const std::string a19(19, 'a'), a20(20, 'a'), a70(70, 'a'), a60(60, 'a');
    EXPECT_EQ(shortHelp(a19 + "; rest of it: and on"), a19 + "; rest of it");
    for (const char* pause : {"; ", ": ", " (", ". "})
        EXPECT_EQ(shortHelp(a20 + pause + "rest"), a20) << pause;
    EXPECT_EQ(shortHelp(a70), a70);
    EXPECT_EQ(shortHelp(a60 + " bbbb ccccc dddd"), a60 + " bbbb");
    EXPECT_EQ(shortHelp(a60 + " bbbb, cccc dddd"), a60 + " bbbb,");
    EXPECT_EQ(shortHelp("short"), "short");
}

TEST(HelpText, onlyControlCharactersAreEscaped)
{
    EXPECT_EQ(printable("a b~"), "a b~");
    EXPECT_EQ(printable("\n\t\x1b\x1f\x7f"), "\\n\\x09\\x1b\\x1f\\x7f");
    EXPECT_EQ(printable("\xc2\x80\xc2\x9f\xc2\xa0\xc3\x85"), "\\x80\\x9f\xc2\xa0\xc3\x85");
    EXPECT_EQ(printable("\xc2"), "\xc2"); // half a UTF-8 character
}

// Two commands below another one, and the options of each.
TEST(Arguments, aCommandBelowAnotherHasBothNames)
{
    Arguments tool("tool", "what it is", "1.2.3");
    Arguments map = tool.command("map", "what maps need");
    std::string from = "x", to = "y", ran, printed;
    for (const char* name : {"turn", "mix"}) {
        Arguments command = map.command(name, std::string("does ") + name);
        EXPECT_EQ(command.name(), name);
        command.option("FROM", from, "first").reads().required();
        command.option("-t,--to", to, "last").in("FILE").writes();
        command.does([&ran, name] {
            ran += name;
            return Status(Done{});
        });
    }
    const auto print = [&](const std::string& text) { printed += text; };
    for (const char* name : {"turn", "mix"}) {
        const auto given = tool.parse({"map", name, "a", "-t", "b"});
        ASSERT_TRUE(given);
        EXPECT_EQ(given->name, "map " + std::string(name));
        ASSERT_EQ(given->options.size(), 2u);
        EXPECT_EQ(given->options[0].name, "FROM");
        EXPECT_EQ(given->options[0].values, std::vector<std::string>{"a"});
        EXPECT_TRUE(given->options[0].use == FileUse::reads);
        EXPECT_EQ(given->options[1].name, "to");
        EXPECT_EQ(given->options[1].values, std::vector<std::string>{"b"});
        EXPECT_TRUE(given->options[1].use == FileUse::writes);
    }
    EXPECT_EQ(ran, "");
    ASSERT_TRUE(tool.run({"map", "mix", "c"}, print));
    EXPECT_EQ(ran, "mix");
    EXPECT_EQ(from, "c");
    EXPECT_EQ(printed, "");
    const auto errorOf = [&](const std::vector<std::string>& words) {
        const Status done = tool.run(words, print);
        return done ? "" : done.error().message;
    };
    EXPECT_EQ(errorOf({"map"}), "map needs a command: turn or mix (see tool map --help)");
    EXPECT_EQ(errorOf({"map", "turn"}), "map turn needs FROM (see tool map turn --help)");
    EXPECT_EQ(errorOf({"map", "turn", "a", "--ot", "b"}),
              "unknown option --ot; did you mean --to? (see tool map turn --help)");
    EXPECT_EQ(errorOf({"map", "turn", "a", "--to"}), "--to needs a value: --to FILE (see tool map turn --help)");
    EXPECT_EQ(errorOf({"map", "tun"}), "unknown map command 'tun'; did you mean turn?");
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{"map", "turn", "--help"}, {"map", "turn", "-h"}}) {
        printed.clear();
        EXPECT_TRUE(tool.run(words, print));
        EXPECT_EQ(printed.substr(0, printed.find('\n')), "does turn");
        EXPECT_NE(printed.find("Usage: tool map turn FROM [OPTIONS]\n"), std::string::npos) << printed;
    }
    EXPECT_EQ(tool.parse({"map", "turn", "--help"}).error().message,
              "expected a command that does something; found --help or --version");
    const CommandHelp help = tool.describe();
    ASSERT_EQ(help.commands.size(), 1u);
    ASSERT_EQ(help.commands[0].commands.size(), 2u);
    EXPECT_EQ(help.commands[0].commands[1].name, "mix");
    EXPECT_EQ(help.commands[0].commands[1].options[0].names, std::vector<std::string>{"FROM"});
    EXPECT_EQ(help.commands[0].commands[1].options[0].value, "FROM");
    EXPECT_TRUE(help.commands[0].commands[1].options[0].kind == ValueKind::file);
}

// A name is suggested if at most one letter, plus one for every four, differ; the nearer of two is preferred.
TEST(Arguments, theNearestOptionIsSuggested)
{
    Arguments tool("tool", "what it is", "1");
    Arguments command = tool.command("do", "what it does");
    std::string value;
    for (const char* name : {"--abc", "--abd", "--longer", "--elsewhere", "--another-word"})
        command.option(name, value, "");
    command.does([] { return Status(Done{}); });
    const auto meant = [&](const std::string& word) {
        const std::string message = tool.run({"do", word, "x"}, {}).error().message;
        const std::string begin = "; did you mean ";
        const std::size_t at = message.find(begin);
        return at == std::string::npos ? "" : message.substr(at + begin.size(), message.find('?') - at - begin.size());
    };
    for (const auto& [word, name] : {std::pair("--abx", "--abc"), // the first of two equally near names
                                     {"--abdd", "--abd"},
                                     {"--xyc", ""}, // two letters of three
                                     {"--longre", "--longer"},
                                     {"--lonxxr", "--longer"},       // two of six
                                     {"--loxxxr", ""},               // three of six
                                     {"--elsxxxere", "--elsewhere"}, // three of nine
                                     {"--elxxxxere", ""},            // four of nine
                                     {"--ano", "--another-word"},    // its beginning
                                     {"--an", ""}})                  // two letters are the beginning of too many
        EXPECT_EQ(meant(word), name) << word;
    const auto errorOf = [&](const std::string& word) { return tool.run({"do", word, "x"}, {}).error().message; };
    const std::string long100 = "--" + std::string(98, 'y'), long101 = long100 + "y";
    EXPECT_EQ(errorOf(long100), "unknown option " + long100 + " (see tool do --help)");
    EXPECT_EQ(errorOf(long101), "unknown option of 101 letters (see tool do --help)");
}

} // namespace
} // namespace cotan
