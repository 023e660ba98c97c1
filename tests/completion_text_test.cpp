// Completion of a made-up tool for each shell: an option of every kind and nested commands. The expected scripts were
// written by hand.
#include <gtest/gtest.h>

#include "help/help_files.hpp"
#include "terminal/command_walk.hpp"

namespace cotan {

using namespace app;
namespace {

OptionHelp optionOf(std::vector<std::string> names, const std::string& value, const std::string& help,
                    std::vector<std::string> words = {})
{
    OptionHelp option;
    option.names = std::move(names);
    option.value = value;
    option.kind = valueKind(value);
    option.help = help;
    option.words = std::move(words);
    return option;
}

OptionHelp operandOf(const std::string& name, std::vector<std::string> words = {})
{
    OptionHelp option = optionOf({name}, name, "what it works on", std::move(words));
    option.kind = ValueKind::file;
    option.positional = true;
    return option;
}

CommandHelp commandOf(const std::string& name, const std::string& summary)
{
    CommandHelp command;
    command.name = name;
    command.summary = summary;
    return command;
}

// The tool: its commands are `map`, which has `turn`, and `paint`.
CommandHelp tool()
{
    CommandHelp turn = commandOf("turn", "Turn it's.");
    OptionHelp from = operandOf("FROM"), rest = operandOf("REST");
    from.required = true;
    rest.repeated = true;
    OptionHelp parts = optionOf({"--parts"}, "A,B", "parts", {"x", "y"});
    parts.repeated = true;
    turn.options = {from,
                    rest,
                    optionOf({"-o", "--output"}, "FILE", "where it goes"),
                    optionOf({"--frame"}, "NAME", "which: [x]", {"a", "b"}),
                    optionOf({"--size"}, "N", R"(it's a \ b)"),
                    parts,
                    optionOf({"--more"}, "WORDS", "more of them to choose from, and so on: not shown"),
                    optionOf({"--light"}, "NAME|FILE", "a lamp", {"sun", "sky"}),
                    optionOf({"--folder"}, "DIR", "a place"),
                    optionOf({"-q", "--quiet"}, "", "say nothing")};
    CommandHelp map = commandOf("map", "Maps: all."), paint = commandOf("paint", "Paint it."),
                all = commandOf("tool", "All of it.");
    map.commands = {turn};
    paint.options = {operandOf("MODE", {"up", "down"})};
    all.options = {optionOf({"--version"}, "", "print it")};
    all.commands = {map, paint};
    return all;
}

// The text after `begin` and before `end`.
std::string between(const std::string& text, const std::string& begin, const std::string& end)
{
    const std::size_t at = text.find(begin);
    if (at == std::string::npos)
        return "no " + begin;
    const std::size_t from = at + begin.size();
    return text.substr(from, text.find(end, from) - from);
}

TEST(Completion, forZshHasAFunctionForEachCommandWithEveryOption)
{
    EXPECT_EQ(zshCompletion(tool()), R"x(#compdef tool
# Completion of tool for zsh; made from the same table as `tool --help`.

_tool() {
    local curcontext="$curcontext" state line
    local -a commands
    _arguments -C \
        '--version[print it]' \
        ': :->command' '*:: :->words'
    case $state in
        command)
            commands=(
                'map:Maps: all.'
                'paint:Paint it.'
            )
            _describe -t commands command commands ;;
        words)
            case $line[1] in
                map) _tool_map ;;
                paint) _tool_paint ;;
            esac ;;
    esac
}

_tool_map() {
    local curcontext="$curcontext" state line
    local -a commands
    _arguments -C \
        ': :->command' '*:: :->words'
    case $state in
        command)
            commands=(
                'turn:Turn it'\''s.'
            )
            _describe -t commands command commands ;;
        words)
            case $line[1] in
                turn) _tool_map_turn ;;
            esac ;;
    esac
}

_tool_map_turn() {
    _arguments \
        ':FROM:_files' \
        '*:REST:_files' \
        '(-o --output)-o[where it goes]:FILE:_files' \
        '(-o --output)--output=[where it goes]:FILE:_files' \
        '--frame=[which\: \[x\]]:NAME:(a b)' \
        '--size=[it'\''s a \\ b]:N: ' \
        '*--parts=[parts]:A,B:_values -s , word x y' \
        '--more=[more of them to choose from, and so on]:WORDS: ' \
        '--light=[a lamp]:NAME|FILE:{compadd -- sun sky; _files}' \
        '--folder=[a place]:DIR:_files -/' \
        '(-q --quiet)-q[say nothing]' \
        '(-q --quiet)--quiet[say nothing]'
}

_tool_paint() {
    _arguments \
        '::MODE:(up down)'
}

_tool "$@"
)x");
}

TEST(Completion, forBashKnowsTheValuesOfEachOptionOfEachCommand)
{
    const std::string text = bashCompletion(tool());
    EXPECT_EQ(between(text, "    case \"$command $before\" in\n", "    esac\n"),
              R"x(        "map turn -o" | "map turn --output") value=yes takes=file ;;
        "map turn --frame") value=yes words="a b" ;;
        "map turn --size") value=yes ;;
        "map turn --parts") value=yes words="x y" list=yes ;;
        "map turn --more") value=yes list=yes ;;
        "map turn --light") value=yes words="sun sky" takes=file ;;
        "map turn --folder") value=yes takes=folder ;;
)x");
    EXPECT_EQ(between(text, "    [[ -n $value ]] || case \"$command\" in\n", "    esac\n"),
              R"x(        "") options="--version" commands="map paint" ;;
        "map") options="" commands="turn" ;;
        "map turn") options="-o --output --frame --size --parts --more --light --folder -q --quiet" takes=file ;;
        "paint") options="" takes=word words="up down" ;;
)x");
    EXPECT_EQ(between(text, "        case \"$command/${COMP_WORDS[i]}\" in\n", "            *)"),
              R"x(            "/map" | "/paint" | "map/turn") command+="${command:+ }${COMP_WORDS[i]}" ;;
)x");
    EXPECT_TRUE(
        text.starts_with("# Completion of tool for bash; made from the same table as `tool --help`.\n_tool()\n"));
    EXPECT_TRUE(text.ends_with("\ncomplete -F _tool tool\n"));
    for (const char* word : {"TOOL", "COMMANDS"})
        EXPECT_EQ(text.find(word), std::string::npos) << word;
}

TEST(Completion, forFishHasALineForEachOptionAndCommand)
{
    const std::string text = fishCompletion(tool());
    const std::string begin = "complete -c tool -f\n";
    const std::size_t start = text.find(begin);
    ASSERT_NE(start, std::string::npos);
    const auto at = [](const std::string& path) { return "complete -c tool -n '__tool_at \"" + path + "\"' "; };
    const std::string turn = at("map turn");
    EXPECT_EQ(text.substr(start + begin.size()),
              at("") + "-a map -d 'Maps: all.'\n" + at("") + "-a paint -d 'Paint it.'\n" + at("")
                  + "-l version -d 'print it'\n" + at("map") + "-a turn -d 'Turn it\\'s.'\n" + turn + "-F\n" + turn
                  + "-F\n" + turn + "-s o -l output -r -F -d 'where it goes'\n" + turn
                  + "-l frame -x -a 'a b' -d 'which: [x]'\n" + turn + R"x(-l size -x -d 'it\'s a \\ b')x" + "\n" + turn
                  + R"x(-l parts -x -a '(__fish_complete_list , "string split \' \' \'x y\'")' -d 'parts')x" + "\n"
                  + turn + R"x(-l more -x -a '(__fish_complete_list , "string split \' \' \'\'")' )x"
                  + "-d 'more of them to choose from, and so on'\n" + turn + "-l light -r -F -a 'sun sky' -d 'a lamp'\n"
                  + turn + "-l folder -x -a '(__fish_complete_directories)' -d 'a place'\n" + turn
                  + "-s q -l quiet -d 'say nothing'\n" + at("paint") + "-a 'up down'\n");
    EXPECT_NE(text.find("contains -- \"$at/$word\" '/map' '/paint' 'map/turn'; or break\n"), std::string::npos);
    for (const char* word : {"TOOL", "COMMANDS"})
        EXPECT_EQ(text.find(word), std::string::npos) << word;
}

TEST(Completion, filesCoverEachShellAndEachCommand)
{
    const CommandHelp all = tool();
    const CommandHelp &map = all.commands[0], &turn = map.commands[0], &paint = all.commands[1];
    const std::vector<std::pair<std::string, std::string>> expected = {
        {"bash-completion/completions/tool", bashCompletion(all)},
        {"zsh/vendor-completions/_tool", zshCompletion(all)},
        {"fish/vendor_completions.d/tool.fish", fishCompletion(all)},
        {"man/man1/tool.1", manPage({&all}, "4.5")},
        {"man/man1/tool-map.1", manPage({&all, &map}, "4.5")},
        {"man/man1/tool-map-turn.1", manPage({&all, &map, &turn}, "4.5")},
        {"man/man1/tool-paint.1", manPage({&all, &paint}, "4.5")}};
    const auto files = helpFiles(all, "4.5");
    ASSERT_EQ(files.size(), expected.size());
    for (std::size_t i = 0; i < files.size(); ++i) {
        EXPECT_EQ(files[i].path, expected[i].first);
        EXPECT_EQ(files[i].text, expected[i].second) << files[i].path;
    }
}

// The page names a place for reports only if whoever publishes Cotan has filled one in.
TEST(Completion, onlyThePageOfTheToolNamesTheRepository)
{
    const CommandHelp all = tool();
    const std::string section = ".SH \"REPORTING BUGS\"\nhttps://forge.example/cotan\n";
    EXPECT_EQ(manPage({&all}, "4.5").find("REPORTING"), std::string::npos);
    EXPECT_NE(manPage({&all}, "4.5", "https://forge.example/cotan").find(section), std::string::npos);
    EXPECT_EQ(manPage({&all, &all.commands[0]}, "4.5", "https://forge.example/cotan").find("REPORTING"),
              std::string::npos);
    EXPECT_NE(helpFiles(all, "4.5", "https://forge.example/cotan")[3].text.find(section), std::string::npos);
}

// Characters that roff would treat as commands or typeset as other characters.
TEST(Completion, pagesEscapeRoffCharacters)
{
    CommandHelp all = commandOf("tool", "GLTF\nthings"), inner = commandOf("do-it", "a-b is it"),
                last = commandOf("last", "glTF, of course");
    inner.options = {optionOf({"--a"}, "N", R"x(.x is `y\z)x"),
                     optionOf({"--b"}, "N", "'q' (--c-d \"-1 well-known"),
                     optionOf({"--c"}, "N", "and so on..."),
                     optionOf({"--d"}, "N", "see: it."),
                     optionOf({"--e"}, "N", "a,B"),
                     optionOf({"--f"}, "N", "")};
    inner.examples = {R"x(.tool 'a' `b` ^~ c\d -e)x"};
    inner.closing = "Ends with 0.";
    last.heading = "Others";
    all.commands = {inner, last};
    const std::string page = manPage({&all, &all.commands[0]}, "4.5-6");
    const std::string name = "tool\\-do\\-it";
    EXPECT_EQ(page,
              ".\\\" Made from the same table as \"tool do-it --help\".\n"
              ".TH TOOL\\-DO\\-IT 1 \"\" \"tool 4.5-6\" \"User Commands\"\n.nh\n.ad l\n"
              ".SH NAME\n"
                  + name
                  + " \\- a-b is it\n.SH SYNOPSIS\n\\fBtool do\\-it\\fR [\\fIOPTIONS\\fR]\n"
                    ".SH OPTIONS\n.SS "
                  + std::string(headingOf(inner.options[0].group))
                  + "\n.TP\n\\fB\\-\\-a\\fR \\fIN\\fR\n\\&.x is \\(gay\\ez.\n"
                    ".TP\n\\fB\\-\\-b\\fR \\fIN\\fR\n\\&'q' (\\-\\-c\\-d \"\\-1 well-known.\n"
                    ".TP\n\\fB\\-\\-c\\fR \\fIN\\fR\nAnd so on...\n"
                    ".TP\n\\fB\\-\\-d\\fR \\fIN\\fR\nSee: it.\n"
                    ".TP\n\\fB\\-\\-e\\fR \\fIN\\fR\nA,B.\n"
                    ".TP\n\\fB\\-\\-f\\fR \\fIN\\fR\n\n"
                    ".SH EXAMPLES\n.PP\n.EX\n\\&.tool \\(aqa\\(aq \\(gab\\(ga \\(ha\\(ti c\\ed \\-e\n.EE\n"
                    ".SH \"EXIT STATUS\"\nEnds with 0.\n.SH \"SEE ALSO\"\n\\fBtool\\fR(1)\n");
    const std::string whole = manPage({&all}, "1");
    EXPECT_NE(whole.find(".SH NAME\ntool \\- GLTF things\n"), std::string::npos) << whole;
    // A heading is printed where it changes.
    EXPECT_NE(whole.find(".SH COMMANDS\nEach has a page of its own.\n.TP\n\\fB" + name
                         + "\\fR(1)\nA-b is it.\n.SS \"Others\"\n.TP\n\\fBtool\\-last\\fR(1)\nglTF, of course.\n"),
              std::string::npos)
        << whole;
}

} // namespace
} // namespace cotan
