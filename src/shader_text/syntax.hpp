// The portable text as a tree: what that is, how text becomes one, and what is done to it before it is printed. It is a
// small language: structs, functions, declarations, assignments, if, return, and expressions without side effects.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cotan::shader_text {

// ---- the tree ------------------------------------------------------------------------------

struct Expression {
    enum class Kind {
        number, // text
        name,   // text
        member, // children[0].text
        call,   // text(children)
        unary,  // text children[0]
        binary, // children[0] text children[1]
        select, // children[0] ? children[1] : children[2]
        paren,  // (children[0])
    };
    Kind kind = Kind::name;
    std::string text;
    std::vector<Expression> children;
};

struct Statement {
    enum class Kind {
        declare,  // type name = value, or without a value
        assign,   // target = value
        branch,   // if (value) body
        giveBack, // return value, or only return
        run,      // value, a call that gives nothing back
    };
    Kind kind = Kind::declare;
    std::vector<std::string> comments{}; // the lines above it, with their slashes
    std::string type{}, name{};
    Expression target{}, value{};
    bool hasValue = true;
    std::vector<Statement> body{};
};

struct Variable {
    std::string type, name;
    std::string comment; // of a field, on its line
    bool out = false;    // a parameter that takes what the function gives back
};

struct Struct {
    std::vector<std::string> comments;
    std::string name;
    std::vector<Variable> fields;
};

struct Function {
    std::vector<std::string> comments;
    std::string part; // file it is from, without ".h"
    std::string type, name;
    std::vector<Variable> parameters;
    std::vector<Statement> body;
};

struct Module {
    std::vector<Struct> structs;
    std::vector<Function> functions; // before use
};

// Calls visit(expression) for the expression and all below it.
template<class Node, class Visit> void visitAll(Node& e, const Visit& visit)
{
    visit(e);
    for (auto& child : e.children)
        visitAll(child, visit);
}

// The same for all expressions of statements, targets included.
template<class Body, class Visit> void visitBody(Body& body, const Visit& visit)
{
    for (auto& s : body) {
        if (s.kind == Statement::Kind::assign)
            visitAll(s.target, visit);
        if (s.hasValue)
            visitAll(s.value, visit);
        visitBody(s.body, visit);
    }
}

// ---- from text -----------------------------------------------------------------------------

struct PortablePart {
    std::string_view name; // of the file, without ".h"
    std::string_view text;
};

// The files of shaders/cotan/, embedded, in the order in which they are joined.
std::span<const PortablePart> portableParts();

// What is left of a text when its #if branches are chosen. A comment above a directive stays
// above what follows it, except for a #define, which takes its comment with it.
struct Preprocessed {
    std::string text;
    std::map<std::string, std::string> constants; // COTAN_NAME to its value
};

// language: COTAN_LANG_GLSL or COTAN_LANG_CPP, the one macro that is defined.
Preprocessed preprocess(std::string_view text, std::string_view language);

// Appends what `text` defines. Constants are put in the place of their names; `constants` holds those of earlier texts
// and receives the new ones. Throws std::runtime_error with the line where the text leaves the small language.
void parsePart(Module& module, std::map<std::string, Expression>& constants, std::string_view part,
               std::string_view text, std::string_view language);

// ---- to what a language prints -------------------------------------------------------------

// Puts `value` in the place of parameter `name` of `function` (of its field `field` unless that is
// empty). A parameter without a field goes from the function and from all calls.
void bindArgument(Module& module, const std::string& function, const std::string& name, const std::string& field,
                  const std::string& value);

// Decides comparisons of numbers, selects and ifs that hang on them, factors of 1 and -1; joins a
// declaration with the assignment that follows; drops variables that nothing reads.
void simplify(Function& function);

// What the functions named in `roots` need, in the module's order; structs too.
Module neededBy(const Module& module, const std::vector<std::string>& roots);

// Each variable of a struct becomes one variable for each field, NAME_FIELD; parameters too. A function that returns a
// struct returns nothing and has `out` parameters behind its others.
// Throws std::runtime_error where a struct hangs on ?: or a name is taken.
Module withoutStructs(const Module& module);

} // namespace cotan::shader_text
