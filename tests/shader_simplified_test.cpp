// Transformations of portable functions before they are printed (known values are substituted, unused code is removed),
// and errors with line numbers for text that is not portable.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "cotan/shader_text.hpp"
#include "languages.hpp"
#include "syntax.hpp"

namespace cotan::shader_text {
namespace {

Module parsed(const std::string& text)
{
    Module module;
    std::map<std::string, Expression> constants;
    parsePart(module, constants, "test", text, "COTAN_LANG_GLSL");
    return module;
}

// ---- simplified functions -------------------------------------------------------------------

// The body of a function f(cotan_real x), simplified, in GLSL.
std::string simplified(const std::string& body)
{
    Module module;
    std::map<std::string, Expression> constants;
    parsePart(module, constants, "test", "COTAN_FUNCTION cotan_real f(cotan_real x)\n{\n" + body + "}\n",
              "COTAN_LANG_GLSL");
    simplify(module.functions.at(0));
    const std::string text = print(module, Language::glsl);
    return text.substr(text.find("{\n") + 2);
}

TEST(SimplifiedText, declarationsAbsorbTheAssignmentThatFollows)
{
    EXPECT_EQ(simplified("    cotan_real a = x;\n    a = x * x;\n    return a * a;\n"),
              "    float a = x * x;\n    return a * a;\n}\n");
    const std::string reading = "    float a = x;\n    a = a * x;\n    return a * a;\n}\n";
    EXPECT_EQ(simplified("    cotan_real a = x;\n    a = a * x;\n    return a * a;\n"), reading);
}

TEST(SimplifiedText, aliasesAreRemovedUnlessTheOriginalIsReadAgain)
{
    EXPECT_EQ(simplified("    cotan_real a = x * x;\n    cotan_real b = a;\n    return b * b;\n"),
              "    float b = x * x;\n    return b * b;\n}\n");
    EXPECT_EQ(simplified("    cotan_real a = x * x;\n    cotan_real b = a;\n    return a * b;\n"),
              "    float a = x * x;\n    float b = a;\n    return a * b;\n}\n");
}

// Expressions with known values are evaluated; similar ones without stay.
TEST(SimplifiedText, expressionsWithKnownValuesAreEvaluated)
{
    const std::pair<const char*, const char*> cases[] = {{"x * 1.0", "x"},
                                                         {"x * -1.0", "-x"},
                                                         {"x + 1.0", "x + 1.0"},
                                                         {"x / 1.0", "x / 1.0"},
                                                         {"x + -1.0", "x + -1.0"},
                                                         {"x - -1.0", "x - -1.0"},
                                                         {"x / -1.0", "x / -1.0"},
                                                         {"x * -2.0", "x * -2.0"},
                                                         {"x * 2.0", "x * 2.0"},
                                                         {"x * -x", "x * -x"},
                                                         {"1.0 * x", "1.0 * x"},
                                                         {"(x) * x", "x * x"},
                                                         {"(-x) * x", "-x * x"},
                                                         {"(x + x) * x", "(x + x) * x"},
                                                         {"(x < x ? x : 2.0) * x", "(x < x ? x : 2.0) * x"},
                                                         {"1.0 == 1.0 ? x : 2.0", "x"},
                                                         {"1.0 == 3.0 ? x : 2.0", "2.0"},
                                                         {"1.0 < 1.0 ? x : 2.0", "1.0 < 1.0 ? x : 2.0"},
                                                         {"1.0 == x ? x : 2.0", "1.0 == x ? x : 2.0"},
                                                         {"x == 1.0 ? x : 2.0", "x == 1.0 ? x : 2.0"},
                                                         {"x == x ? x : 2.0", "x == x ? x : 2.0"},
                                                         {"true ? x : 2.0", "x"},
                                                         {"false ? x : 2.0", "2.0"},
                                                         {"min(x * 1.0, (x))", "min(x, x)"}};
    for (const auto& [given, kept] : cases)
        EXPECT_EQ(simplified("    return " + std::string(given) + ";\n"), "    return " + std::string(kept) + ";\n}\n")
            << given;
}

TEST(SimplifiedText, decidedBranchesAndUnusedVariablesAreRemoved)
{
    const std::string end = "    return x;\n}\n";
    EXPECT_EQ(simplified("    if (1.0 == 1.0)\n        x = 2.0;\n    x = x * x;\n    return x;\n"),
              "    x = 2.0;\n    x = x * x;\n" + end);
    EXPECT_EQ(simplified("    if (1.0 == 2.0)\n        x = 2.0;\n    x = x * x;\n    return x;\n"),
              "    x = x * x;\n" + end);
    EXPECT_EQ(simplified("    if (x < 2.0)\n        x = 2.0 * 1.0;\n    return x;\n"),
              "    if (x < 2.0) {\n        x = 2.0;\n    }\n" + end);
    EXPECT_EQ(simplified("    cotan_real a = x;\n    cotan_real b = a * x;\n    return x;\n"), end);
    EXPECT_EQ(simplified("    cotan_real a = x;\n    x = a * a;\n    return x;\n"),
              "    float a = x;\n    x = a * a;\n" + end);
    // A declaration absorbs only an assignment to its own variable that follows immediately.
    EXPECT_EQ(simplified("    cotan_real a = 1.0;\n    x = 2.0;\n    a = x;\n    return a * x;\n"),
              "    float a = 1.0;\n    x = 2.0;\n    a = x;\n    return a * x;\n}\n");
    EXPECT_EQ(simplified("    cotan_real a;\n    a = x * x;\n    return a * a;\n"),
              "    float a = x * x;\n    return a * a;\n}\n");
    // A variable is replaced by its value only where that is its whole use.
    EXPECT_EQ(simplified("    cotan_real a = x * x;\n    cotan_real b = -a;\n    return b * b;\n"),
              "    float a = x * x;\n    float b = -a;\n    return b * b;\n}\n");
}

// ---- arguments ------------------------------------------------------------------------------

const char* const kThree = "struct cotan_two {\n    cotan_real a;\n    cotan_real b;\n};\n"
                           "struct cotan_other {\n    cotan_real a;\n};\n"
                           "COTAN_FUNCTION cotan_real f(cotan_real x, cotan_two t, cotan_real y)\n{\n"
                           "    if (x < y)\n        return t.b;\n    return x * t.a + y;\n}\n"
                           "COTAN_FUNCTION cotan_real g(cotan_real x, cotan_two t)\n{\n"
                           "    return f(x, t, 2.0) + f(t.a, t, x);\n}\n"
                           "COTAN_FUNCTION cotan_real h(cotan_other o)\n{\n    return o.a;\n}\n";

std::string printedWith(const char* name, const char* field, const char* value)
{
    Module module = parsed(kThree);
    bindArgument(module, "f", name, field, value);
    const std::string text = print(neededBy(module, {"g"}), Language::glsl);
    return text.substr(text.find("float f("));
}

TEST(BoundArgument, replacesItsParameterAndLeavesEveryCall)
{
    EXPECT_EQ(printedWith("x", "", "3.0"),
              "float f(cotan_two t, float y)\n{\n    if (3.0 < y) {\n        return t.b;\n    }\n"
              "    return 3.0 * t.a + y;\n}\n\n"
              "float g(float x, cotan_two t)\n{\n    return f(t, 2.0) + f(t, x);\n}\n");
    EXPECT_EQ(printedWith("y", "", "-0.5"),
              "float f(float x, cotan_two t)\n{\n    if (x < -0.5) {\n        return t.b;\n    }\n"
              "    return x * t.a + -0.5;\n}\n\n"
              "float g(float x, cotan_two t)\n{\n    return f(x, t) + f(t.a, t);\n}\n");
    EXPECT_EQ(printedWith("t", "b", "1.0"),
              "float f(float x, cotan_two t, float y)\n{\n    if (x < y) {\n        return 1.0;\n    }\n"
              "    return x * t.a + y;\n}\n\n"
              "float g(float x, cotan_two t)\n{\n    return f(x, t, 2.0) + f(t.a, t, x);\n}\n");
}

TEST(NeededText, containsWhatTheRootsCallAndTheirStructs)
{
    const auto names = [](const std::vector<std::string>& roots) {
        const Module needed = neededBy(parsed(kThree), roots);
        std::string all;
        for (const Struct& s : needed.structs)
            all += s.name + " ";
        for (const Function& f : needed.functions)
            all += f.name + " ";
        return all;
    };
    EXPECT_EQ(names({"f"}), "cotan_two f ");
    EXPECT_EQ(names({"g"}), "cotan_two f g ");
    EXPECT_EQ(names({"h"}), "cotan_other h ");
    EXPECT_EQ(names({"h", "f"}), "cotan_two cotan_other f h ");
    EXPECT_EQ(names({}), "");
}

// ---- text that is not portable --------------------------------------------------------------

std::string errorOf(const std::string& text)
{
    try {
        parsed(text);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

TEST(ParsedText, syntaxErrorsNameTheirLine)
{
    const std::string head = "COTAN_FUNCTION cotan_real f(cotan_real x)\n{\n";
    const auto line = [](int number) {
        return "test.h, line " + std::to_string(number) + " (preprocessed): expected ";
    };
    const std::pair<std::string, std::string> cases[] = {
        {head + "    return x;\n}\n", ""},
        {head + "    // a comment\n\n    return x; // another\n}\n", ""},
        {head + "    return x\n}\n", line(4) + "';'; found '}'"},
        {head + "    // a comment\n    return x\n}\n", line(5) + "';'; found '}'"},
        {head + "    return ;\n}\n", line(3) + "an expression; found ';'"},
        {head + "    return (x;\n}\n", line(3) + "')'; found ';'"},
        {head + "    return x ? x;\n}\n", line(3) + "':'; found ';'"},
        {head + "    return f(x x);\n}\n", line(3) + "','; found 'x'"},
        {head + "    x + x;\n}\n", line(3) + "'='; found '+'"},
        {head + "    if x < x\n        return x;\n}\n", line(3) + "'('; found 'x'"},
        {head + "    return x;\n", line(4) + "an expression; found ''"},
        {"struct two {\n", line(2) + "more; found ''"},
        {"struct two {\n    cotan_real a;\n}\n", line(4) + "';'; found ''"},
        {"struct two {\n    cotan_real a\n};\n", line(3) + "';'; found '}'"},
        {"COTAN_FUNCTION cotan_real f(cotan_real x cotan_real y)\n{\n}\n", line(1) + "','; found 'cotan_real'"},
        {"#define COTAN_A 1.0 2.0\n", line(1) + "nothing more; found '2.0'"}};
    for (const auto& [text, expected] : cases)
        EXPECT_EQ(errorOf(text), expected) << text;
}

TEST(ParsedText, operatorsAndNumbersParseAsInC)
{
    const auto valueOf = [](const std::string& text) {
        const Module module = parsed("cotan_real f(cotan_real x)\n{\n    return " + text + ";\n}\n");
        return module.functions.at(0).body.at(0).value;
    };
    // Ordered from loose to tight: each operator is the root above any that follows it.
    const std::vector<std::vector<std::string>> levels = {
        {"||"}, {"&&"}, {"|"}, {"&"}, {"==", "!="}, {"<", ">", "<=", ">="}, {"<<", ">>"}, {"+", "-"}, {"*", "/"}};
    for (std::size_t i = 0; i < levels.size(); ++i)
        for (std::size_t k = i; k < levels.size(); ++k)
            for (const std::string& loose : levels[i])
                for (const std::string& tight : levels[k]) {
                    const std::string last = "x " + loose + " y " + tight + " z";
                    EXPECT_EQ(valueOf(last).text, i == k ? tight : loose) << last; // left-associative
                    const std::string first = "x " + tight + " y " + loose + " z";
                    EXPECT_EQ(valueOf(first).text, loose) << first;
                }
    EXPECT_EQ(valueOf("x + y ? x : y").kind, Expression::Kind::select);
    EXPECT_EQ(valueOf("-x.y").kind, Expression::Kind::unary);
    for (const char* const number : {"1", "1.5", "1e5", "1e-5", "1.5e+3", "0x7fe0u", "0xeu", "2u"}) {
        EXPECT_EQ(valueOf(number).text, number);
        EXPECT_EQ(valueOf(number).kind, Expression::Kind::number);
        EXPECT_EQ(valueOf(std::string(number) + "-x").text, "-") << number;
    }
    EXPECT_EQ(valueOf("0xe-1").text, "-");
    EXPECT_EQ(valueOf("xe-1").text, "-");
}

} // namespace
} // namespace cotan::shader_text
