// The syntax tree of the portable text, its parser, and transformations before printing. The text is in a small
// language: structs, functions, declarations, assignments, if, return, and expressions without side effects.
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
        declare,     // type name = value, or without a value
        assign,      // target = value
        branch,      // if (value) body
        returnValue, // return value, or only return
        callOnly,    // value, a call without a result
    };
    Kind kind = Kind::declare;
    std::vector<std::string> comments{}; // the lines above it, including their slashes
    std::string type{}, name{};
    Expression target{}, value{};
    bool hasValue = true;
    std::vector<Statement> body{};
};

struct Variable {
    std::string type, name;
    std::string comment; // after a field, on the same line
    bool out = false;    // an output parameter
};

struct Struct {
    std::vector<std::string> comments;
    std::string name;
    std::vector<Variable> fields;
};

struct Function {
    std::vector<std::string> comments;
    std::string part; // the source file, without ".h"
    std::string type, name;
    std::vector<Variable> parameters;
    std::vector<Statement> body;
};

struct Module {
    std::vector<Struct> structs;
    std::vector<Function> functions; // definitions precede uses
};

// Calls visit(expression) for an expression and all its descendants.
template<class Node, class Visit> void visitAll(Node& e, const Visit& visit)
{
    visit(e);
    for (auto& child : e.children)
        visitAll(child, visit);
}

// Calls visit for all expressions of statements, including assignment targets.
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

// Returns the files of shaders/cotan/, embedded, in the order in which they are joined.
std::span<const PortablePart> portableParts();

// A text after its #if branches are selected. A comment above a directive remains above the line after it, except for a
// #define, which is removed together with its comment.
struct Preprocessed {
    std::string text;
    std::map<std::string, std::string> constants; // value of each COTAN_NAME
};

// language: the one macro that is defined, such as COTAN_LANG_GLSL or COTAN_LANG_CPP.
Preprocessed preprocess(std::string_view text, std::string_view language);

// Appends the definitions of `text` to the module, and substitutes constants. `constants` contains those of earlier
// texts; new ones are added. Throws std::runtime_error with the line if the text is not in the small language.
void parsePart(Module& module, std::map<std::string, Expression>& constants, std::string_view part,
               std::string_view text, std::string_view language);

// ---- specialising and printing -------------------------------------------------------------

// Replaces parameter `name` of `function`, or its field `field` unless that is empty, by `value`. A parameter without a
// field is removed from the function and from all calls.
void bindArgument(Module& module, const std::string& function, const std::string& name, const std::string& field,
                  const std::string& value);

// Evaluates comparisons of numbers, selects and ifs with constant conditions, and factors of 1 and -1; joins a
// declaration with the assignment that follows it; removes unread variables.
void simplify(Function& function);

// Returns the functions and structs that the functions named in `roots` need, in the module's order.
Module neededBy(const Module& module, const std::vector<std::string>& roots);

// Replaces each struct variable and parameter by one variable per field, NAME_FIELD. A function that returns a struct
// returns void and gets additional `out` parameters at the end.
// Throws std::runtime_error if a struct is an operand of ?: or a name is taken.
Module withoutStructs(const Module& module);

} // namespace cotan::shader_text
