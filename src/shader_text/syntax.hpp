// The portable text as a tree. It is a small language: structs, functions, declarations,
// assignments, if, return, and expressions without side effects.
#pragma once

#include <string>
#include <vector>

namespace cotan::shader_text {

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

} // namespace cotan::shader_text
