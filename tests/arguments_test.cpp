// A command with every kind of option: the values that each accepts at its bounds, the error beyond them, and the
// values that the help lists.
#include <gtest/gtest.h>

#include <clocale>
#include <cmath>
#include <cstring>
#include <limits>
#include <random>
#include <stdexcept>

#include "core/real_from_chars.hpp"
#include "core/real_number.hpp"
#include "terminal/arguments.hpp"
#include "terminal/command_words.hpp"

namespace cotan {

using namespace app;
namespace {

struct Everything {
    int whole = 3, chosen = 4;
    double real = 0.5;
    float above = 1;
    std::string autoOr = "auto", word = "b", file, output, plain = "x";
    std::vector<std::string> list;
    bool flag = false;
    int runs = 0;
    Arguments tool{"tool", "what it is", "1.2.3"};
    Arguments command = tool.command("do", "what it does");

    Everything()
    {
        tool.command("done", "another").does([] { return Status(Done{}); });
        command.option("MODEL", file, "a model").reads().required();
        command.option("-o,--output", output, "a file").in("FILE").writes();
        command.option("--whole", whole, "a whole number").in("N").within(2, 5);
        command.option("--chosen", chosen, "a number of these").in("K").from({1, 4, 16});
        command.option("--real", real, "a number").in("X").within(-1.5, 2.25);
        command.option("--above", above, "above none").in("X").above0();
        command.option("--auto", autoOr, "above none, or auto").in("X").checked(numberAbove0Or("auto"));
        command.option("--word", word, "one of them").in("WORD").from({"a", "b", "c"});
        command.option("--list", list, "several").in("NAMES").separatedByCommas();
        command.option("--plain", plain, "anything").in("WORD").offers({"p", "q"}).withoutDefault();
        command.option("--hidden", plain, "old").unlisted();
        command.flag("--flag", flag, "yes or no");
        command.examples({"tool do a.glb", "tool do b.glb"}, "It ends with 0.");
        command.does([this] {
            ++runs;
            return Status(Done{});
        });
    }
    Status run(std::vector<std::string> words)
    {
        words.insert(words.begin(), {"do", "m.glb"});
        return tool.run(words, [](const std::string&) {});
    }
};

TEST(Arguments, anOptionThatNamesAFileSaysWhetherItIsReadOrWritten)
{
    std::string file;
    Arguments tool{"tool", "what it is", "1.2.3"};
    Argument option = tool.option("--forgotten", file, "a file").in("NAME|FILE");
    EXPECT_THROW(tool.describe(), std::logic_error);
    option.reads();
    EXPECT_EQ(tool.describe().options.size(), 3u); // with --help and --version
}

// The power of ten of the first digit says whether a number is too large or too small.
TEST(RealNumbers, areParsedInAnySpelling)
{
    const double inf = std::numeric_limits<double>::infinity();
    const std::string zeros(400, '0');
    const std::pair<std::string, double> spellings[] = {{"1.5", 1.5},
                                                        {"+1.5", 1.5},
                                                        {"-.5", -0.5},
                                                        {"5.", 5},
                                                        {"1e+3", 1000},
                                                        {"1e-400", 0},
                                                        {"1e400", inf},
                                                        {"-1e400", -inf},
                                                        {"0." + zeros + "1", 0},
                                                        {"1" + zeros, inf},
                                                        {"0.01e-400", 0},
                                                        {"1" + zeros + "e-500", 1e-100},
                                                        {"0." + zeros + "1e300", 1e-101},
                                                        {"1e99999999999999999999", inf},
                                                        {"1e-99999999999999999999", 0},
                                                        {"inf", inf}};
    for (const auto& [text, expected] : spellings) {
        const auto value = parseReal(text);
        ASSERT_TRUE(value) << text;
        EXPECT_EQ(*value, expected) << text;
    }
    EXPECT_TRUE(std::signbit(*parseReal("-1e-400")));
    EXPECT_TRUE(std::isnan(*parseReal("nan")));
    for (const std::string text : {"", "+", "-", ".", "1,5", "1.5.", "1e", " 1", "1 ", "++1", "+-1", "0x1p3", "1.5f"})
        EXPECT_FALSE(parseReal(text)) << text;
    EXPECT_EQ(textOfReal(0.5), "0.5");
    EXPECT_EQ(textOfReal(1234567), "1.23457e+06");
    EXPECT_EQ(textOfReal(0.1, 17), "0.10000000000000001");
}

// Expects that the command accepts the value or, if `unless` is not empty, that it fails with this one line.
void expectAccepted(const std::string& option, const std::string& value, const std::string& unless = "")
{
    Everything e;
    const Status done = e.run({option, value});
    EXPECT_EQ(bool(done), unless.empty()) << option << " " << value;
    EXPECT_EQ(e.runs, unless.empty() ? 1 : 0);
    if (!done) {
        EXPECT_NE(done.error().message.find(unless), std::string::npos) << done.error().message;
        EXPECT_EQ(done.error().message.find('\n'), std::string::npos);
        EXPECT_EQ(done.error().kind, ErrorKind::usage);
    }
}

TEST(Arguments, numbersAreAcceptedUpToTheirBounds)
{
    for (const char* good : {"2", "3", "5"})
        expectAccepted("--whole", good);
    for (const char* bad : {"1", "6", "-3", "2.5", "x", "4x", "nan"})
        expectAccepted("--whole", bad, "expected a whole number from 2 to 5; found '" + std::string(bad) + "'");
    for (const char* good : {"-1.5", "0", "2.25", "1e-3"})
        expectAccepted("--real", good);
    for (const char* bad : {"-1.51", "2.26", "nan", "inf", "x", "1x"})
        expectAccepted("--real", bad, "expected a number from -1.5 to 2.25; found '" + std::string(bad) + "'");
    for (const char* good : {"1e-6", "1", "1e6"})
        expectAccepted("--above", good);
    for (const char* bad : {"0", "-1", "1.1e6", "nan", "inf", "x", "1x"})
        expectAccepted("--above", bad, "expected a number above 0 and at most 1e6; found '" + std::string(bad) + "'");
    for (const char* good : {"auto", "0.5", "1e6"})
        expectAccepted("--auto", good);
    for (const char* bad : {"0", "automatic", "1.1e6", "nan"})
        expectAccepted("--auto", bad,
                       "expected auto or a number above 0 and at most 1e6; found '" + std::string(bad) + "'");
}

TEST(Arguments, onlyListedChoicesAreAccepted)
{
    for (const char* good : {"1", "4", "16"})
        expectAccepted("--chosen", good);
    for (const char* bad : {"0", "2", "15", "x"})
        expectAccepted("--chosen", bad, "expected 1, 4 or 16; found '" + std::string(bad) + "'");
    for (const char* good : {"a", "b", "c"})
        expectAccepted("--word", good);
    for (const char* bad : {"d", "A", "ab"})
        expectAccepted("--word", bad, "expected a, b or c; found '" + std::string(bad) + "'");
}

// A value that an option's own parser refuses ends the command in place of its work; help and job plans come first.
TEST(Arguments, anInvalidValueEndsTheCommandBeforeItRuns)
{
    Arguments tool("tool", "what it is", "1.2.3");
    Arguments command = tool.command("do", "what it does");
    std::string taken;
    int runs = 0;
    command.option(
        "--even", "2",
        [&](const std::string& text) -> Status {
            taken = text;
            return text == "4" ? Status(Done{}) : Status(usageError("--even: expected 4"));
        },
        "an even number");
    command.does([&] {
        ++runs;
        return Status(Done{});
    });
    std::string printed;
    const auto run = [&](std::vector<std::string> words) {
        return tool.run(std::move(words), [&](const std::string& text) { printed += text; });
    };
    EXPECT_EQ(tool.describe().commands.at(0).options.back().usual, "2");
    const Status wrong = run({"do", "--even", "3"});
    ASSERT_FALSE(wrong);
    EXPECT_EQ(wrong.error().message, "--even: expected 4");
    EXPECT_EQ(runs, 0);
    EXPECT_TRUE(run({"do", "--even", "3", "--help"}));
    EXPECT_NE(printed.find("an even number"), std::string::npos);
    EXPECT_TRUE(tool.parse({"do", "--even", "3"}));
    EXPECT_TRUE(run({"do", "--even", "4"}));
    EXPECT_EQ(taken, "4");
    EXPECT_EQ(runs, 1);
}

TEST(Arguments, errorsNameTheProblemAndThenTheHelp)
{
    const std::pair<std::vector<std::string>, std::string> cases[] = {
        {{"do", "m", "--wole", "3"}, "unknown option --wole; did you mean --whole? (see tool do --help)"},
        {{"do", "m", "--whol=3"}, "unknown option --whol; did you mean --whole? (see tool do --help)"},
        {{"do", "m", "--nothing"}, "unknown option --nothing (see tool do --help)"},
        {{"do", "m", "-x"}, "unknown option -x (see tool do --help)"},
        {{"do", "m", "--" + std::string(1000, 'x')}, "unknown option of 1002 letters (see tool do --help)"},
        {{"do", "m", "n", "o"}, "unexpected word 'n' (see tool do --help)"},
        {{"do", "m", "--whole"}, "--whole needs a value: --whole N (see tool do --help)"},
        {{"do", "m", "--word", "a", "--word", "b"}, "--word is given 2 times; expected once (see tool do --help)"},
        {{"do", "m", "--flag=maybe"}, "--flag takes no value; found 'maybe' (see tool do --help)"},
        {{"do"}, "do needs MODEL (see tool do --help)"},
        {{}, "tool needs a command: do or done (see tool --help)"},
    };
    for (const auto& [words, message] : cases) {
        Everything e;
        const Status done = e.tool.run(words, [](const std::string&) {});
        ASSERT_FALSE(done) << message;
        EXPECT_EQ(done.error().message, message);
        EXPECT_EQ(e.runs, 0);
    }
}

TEST(Arguments, unlistedOptionsAreNotSuggested)
{
    Everything e;
    const Status done = e.run({"--hiden", "x"});
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().message, "unknown option --hiden (see tool do --help)");
}

TEST(Arguments, anAnswerIsPrintedInsteadOfRunningTheCommand)
{
    Everything e;
    e.command.answers("--names", "prints names", [] { return std::string("a\nb"); });
    std::string printed;
    ASSERT_TRUE(e.tool.run({"do", "--names"}, [&](const std::string& text) { printed += text; }));
    EXPECT_EQ(printed, "a\nb\n");
    EXPECT_EQ(e.runs, 0);
}

TEST(Arguments, optionsAreSortedByGroupWithTheMainOnesFirst)
{
    Arguments tool("tool", "It works.", "1");
    Arguments command = tool.command("do", "Does it.");
    std::string value;
    command.option("--quiet", value, "");
    command.group(HelpGroup::light);
    command.option("--lamp", value, "");
    command.option("--file", value, "").under(HelpGroup::input);
    command.option("--size", value, "").main();
    command.option("MODEL", value, "");
    std::vector<std::string> names;
    const CommandHelp help = tool.describe();
    for (const OptionHelp& option : help.commands[0].options)
        names.push_back(option.names.back());
    EXPECT_EQ(names, (std::vector<std::string>{"MODEL", "--size", "--file", "--lamp", "--help", "--quiet"}));
}

TEST(Arguments, valuesArriveInTheirVariables)
{
    Everything e;
    ASSERT_TRUE(e.run({"-o=out.png", "--whole", "5", "--chosen", "16", "--real", "-1", "--above", "2.5", "--auto", "7",
                       "--word", "c", "--list", "x,y", "--flag", "--plain", "p"}));
    EXPECT_EQ(e.file, "m.glb");
    EXPECT_EQ(e.output, "out.png");
    EXPECT_EQ(e.whole, 5);
    EXPECT_EQ(e.chosen, 16);
    EXPECT_EQ(e.real, -1);
    EXPECT_EQ(e.above, 2.5f);
    EXPECT_EQ(e.autoOr, "7");
    EXPECT_EQ(e.word, "c");
    EXPECT_EQ(e.list, (std::vector<std::string>{"x", "y"}));
    EXPECT_TRUE(e.flag);
    EXPECT_EQ(e.plain, "p");
    Everything none;
    ASSERT_TRUE(none.run({}));
    EXPECT_EQ(none.whole, 3);
    EXPECT_EQ(none.autoOr, "auto");
    EXPECT_FALSE(none.flag);
}

TEST(Arguments, parsingRunsNothingAndReturnsTheGivenOptions)
{
    const Everything e;
    const auto given = e.tool.parse({"do", "m.glb", "-o", "a.png", "--flag"});
    ASSERT_TRUE(given);
    EXPECT_EQ(e.runs, 0);
    EXPECT_EQ(given->name, "do");
    ASSERT_EQ(given->options.size(), 3u);
    EXPECT_EQ(given->options[0].name, "MODEL");
    EXPECT_EQ(given->options[0].values, std::vector<std::string>{"m.glb"});
    EXPECT_TRUE(given->options[0].use == FileUse::reads);
    EXPECT_EQ(given->options[1].name, "output");
    EXPECT_TRUE(given->options[1].use == FileUse::writes);
    EXPECT_EQ(given->options[2].name, "flag");
    EXPECT_TRUE(given->options[2].use == FileUse::none);
    for (const std::vector<std::string>& words :
         {std::vector<std::string>{}, {"do"}, {"do", "--help"}, {"--version"}, {"do", "m", "--nothing"}})
        EXPECT_FALSE(Everything().tool.parse(words));
}

TEST(Arguments, helpAndVersionArePrintedAndRunNothing)
{
    Everything e;
    std::string printed;
    const auto print = [&](const std::string& text) { printed += text; };
    ASSERT_TRUE(e.tool.run({"--version"}, print));
    EXPECT_NE(printed.find("1.2.3"), std::string::npos);
    printed.clear();
    ASSERT_TRUE(e.tool.run({"do", "--help"}, print));
    for (const char* part :
         {"what it does", "--whole", "a whole number", "Examples:", "  tool do b.glb", "It ends with 0."})
        EXPECT_NE(printed.find(part), std::string::npos) << part;
    EXPECT_EQ(printed.find("--hidden"), std::string::npos);
    EXPECT_EQ(e.runs, 0);
}

TEST(Arguments, descriptionsHoldEverythingInTheHelp)
{
    const CommandHelp help = Everything().tool.describe();
    EXPECT_EQ(help.name, "tool");
    EXPECT_EQ(help.summary, "what it is");
    ASSERT_EQ(help.commands.size(), 2u);
    const CommandHelp& c = help.commands[0];
    EXPECT_EQ(c.name, "do");
    EXPECT_EQ(c.summary, "what it does");
    EXPECT_EQ(c.examples, (std::vector<std::string>{"tool do a.glb", "tool do b.glb"}));
    EXPECT_EQ(c.closing, "It ends with 0.");
    const auto of = [&](const std::string& name) {
        for (const OptionHelp& o : c.options)
            if (o.names.back() == name)
                return o;
        ADD_FAILURE() << name;
        return OptionHelp{};
    };
    const OptionHelp model = of("MODEL"), output = of("--output"), whole = of("--whole"), real = of("--real");
    EXPECT_TRUE(model.positional);
    EXPECT_TRUE(model.required);
    EXPECT_FALSE(output.positional);
    EXPECT_FALSE(output.required);
    EXPECT_EQ(output.names, (std::vector<std::string>{"-o", "--output"}));
    EXPECT_EQ(output.value, "FILE");
    EXPECT_TRUE(output.kind == ValueKind::file);
    EXPECT_EQ(output.usual, "");
    EXPECT_EQ(whole.minimum, "2");
    EXPECT_EQ(whole.maximum, "5");
    EXPECT_EQ(whole.usual, "3");
    EXPECT_EQ(whole.value, "N");
    EXPECT_EQ(whole.help, "a whole number");
    EXPECT_EQ(real.minimum, "-1.5");
    EXPECT_EQ(real.maximum, "2.25");
    EXPECT_EQ(of("--chosen").words, (std::vector<std::string>{"1", "4", "16"}));
    EXPECT_EQ(of("--word").words, (std::vector<std::string>{"a", "b", "c"}));
    EXPECT_EQ(of("--plain").words, (std::vector<std::string>{"p", "q"}));
    EXPECT_EQ(of("--plain").usual, "");
    EXPECT_TRUE(of("--list").repeated);
    EXPECT_FALSE(of("--word").repeated);
    EXPECT_EQ(of("--flag").value, "");
    EXPECT_TRUE(of("--flag").kind == ValueKind::none);
    for (const OptionHelp& o : c.options)
        EXPECT_NE(o.names.back(), "--hidden");
}

TEST(CommandWords, theNearestCommandIsSuggested)
{
    const CommandNames tool{"tool", {{"render", {}}, {"map", {{"convert", {}}, {"mips", {}}}}}};
    const auto errorOf = [&](const std::vector<std::string>& words) {
        const Status known = checkCommandWords(tool, words);
        return known ? std::string() : known.error().message;
    };
    EXPECT_EQ(errorOf({"render", "x"}), "");
    EXPECT_EQ(errorOf({"map", "mips"}), "");
    EXPECT_EQ(errorOf({"--help", "x"}), "");
    EXPECT_EQ(errorOf({"redner"}), "unknown command 'redner'; did you mean render?");
    EXPECT_EQ(errorOf({"re"}), "unknown command 're'; did you mean render?");
    EXPECT_EQ(errorOf({"map", "mip"}), "unknown map command 'mip'; did you mean mips?");
    EXPECT_EQ(errorOf({"nothing"}), "unknown command 'nothing'; expected one of render, map");
    EXPECT_NE(errorOf({std::string(100, 'x')}).find("expected one of"), std::string::npos);
    EXPECT_EQ(errorOf({std::string(101, 'x')}), "unknown command of 101 letters");
    EXPECT_EQ(editDistance("", "abc"), 3u);
    EXPECT_EQ(editDistance("abc", ""), 3u);
    EXPECT_EQ(editDistance("abcd", "acbd"), 1u); // adjacent letters exchanged
    EXPECT_EQ(editDistance("kitten", "sitting"), 3u);
}

// As std::from_chars: the same end, error and bits.
template<class Real> void expectSameAsStandard(const std::string& text)
{
    Real ours = -7, standards = -7;
    const char* const end = text.data() + text.size();
    const auto found = realFromChars(text.data(), end, ours);
    const auto expected = std::from_chars(text.data(), end, standards);
    ASSERT_EQ(found.ptr - text.data(), expected.ptr - text.data()) << text;
    ASSERT_EQ(found.ec, expected.ec) << text;
    ASSERT_TRUE(std::memcmp(&ours, &standards, sizeof ours) == 0 || (std::isnan(ours) && std::isnan(standards)))
        << text;
}

TEST(RealFromChars, readsRandomTextsAsTheStandardLibraryInAnyLocale)
{
    std::mt19937 random(7);
    const auto below = [&](unsigned n) { return unsigned(random() % n); };
    for (const char* const locale : {"C", "de_DE.UTF-8"}) {
        std::setlocale(LC_ALL, locale); // where the system lacks it, the first one again
        for (int i = 0; i < 50'000; ++i) {
            std::string text;
            for (unsigned size = below(14); size > 0; --size)
                text += below(3) == 0 ? ".eE+-infatyINx "[below(15)] : char('0' + below(10));
            if (below(4) == 0)
                text += (below(2) == 0 ? "e-" : "e") + std::to_string(below(420));
            expectSameAsStandard<double>(text);
            expectSameAsStandard<float>(text);
        }
    }
    std::setlocale(LC_ALL, "C");
}

} // namespace
} // namespace cotan
