#include <map>
#include <stdexcept>

#include "syntax.hpp"

namespace cotan::shader_text {

namespace {

using Kind = Expression::Kind;
using Body = std::vector<Statement>;

class Flattener {
public:
    explicit Flattener(const Module& module)
    {
        for (const Struct& s : module.structs)
            fields_[s.name] = s.fields;
        for (const Function& f : module.functions)
            types_[f.name] = f.type;
    }

    Function function(Function f)
    {
        variables_.clear();
        names_.clear();
        resultName_ = resultNameOf(f);
        std::vector<Variable> parameters;
        for (const Variable& p : f.parameters)
            for (const Variable& part : partsOf(p.type, p.name))
                parameters.push_back(part);
        if (fields_.contains(f.type)) {
            for (Variable part : partsOf(f.type, resultName_)) {
                part.out = true;
                parameters.push_back(part);
            }
            f.type = "void";
        }
        f.parameters = parameters;
        f.body = body(f.body, true);
        return f;
    }

private:
    // Returns the name prefix of the variables for the result: the one local variable that is returned, or "result".
    // Empty if the result is not a struct.
    std::string resultNameOf(const Function& f) const
    {
        if (!fields_.contains(f.type))
            return "";
        std::string only;
        for (const Statement& s : f.body)
            if (s.kind == Statement::Kind::declare && s.type == f.type && !s.hasValue)
                only = s.name;
        const Expression& last = f.body.back().value;
        return last.kind == Kind::name && last.text == only ? only : "result";
    }

    // Returns one variable for each field of a struct; for another type the variable itself.
    std::vector<Variable> partsOf(const std::string& type, const std::string& name)
    {
        std::vector<Variable> parts;
        if (const auto fields = fields_.find(type); fields != fields_.end()) {
            variables_[name] = type;
            for (const Variable& field : fields->second)
                parts.push_back({field.type, name + "_" + field.name, {}});
        } else {
            parts.push_back({type, name, {}});
        }
        for (const Variable& part : parts)
            reserveName(part.name, fields_.contains(type));
        return parts;
    }

    // Plain variables in two scopes may share a name; the name of a part must be unique.
    void reserveName(const std::string& name, bool part)
    {
        const auto [known, fresh] = names_.insert({name, part});
        if (!fresh && (part || known->second))
            throw std::runtime_error("without structs: the name '" + name + "' is taken");
    }

    bool isStruct(const Expression& e) const
    {
        return (e.kind == Kind::name && variables_.contains(e.text))
            || (e.kind == Kind::call && types_.contains(e.text) && fields_.contains(types_.at(e.text)));
    }

    void declare(Body& into, const std::string& type, const std::string& name)
    {
        for (const Variable& part : partsOf(type, name))
            into.push_back({.type = part.type, .name = part.name, .hasValue = false});
    }

    // Assigns a struct: name = value.
    void assign(Body& into, const std::string& name, const Expression& value)
    {
        if (!isStruct(value))
            throw std::runtime_error("without structs: '" + name + "' is made neither of a call nor of a variable");
        const std::vector<Variable>& fields = fields_.at(variables_.at(name));
        Statement s;
        if (value.kind == Kind::call) {
            s.kind = Statement::Kind::callOnly;
            s.value = call(into, value);
            for (const Variable& field : fields)
                s.value.children.push_back({Kind::name, name + "_" + field.name, {}});
            into.push_back(s);
            return;
        }
        s.kind = Statement::Kind::assign;
        for (const Variable& field : fields) {
            s.target = {Kind::name, name + "_" + field.name, {}};
            s.value = {Kind::name, value.text + "_" + field.name, {}};
            into.push_back(s);
        }
    }

    // Returns the name of a variable with the value. For a call, a variable is declared in `into`.
    std::string named(Body& into, const Expression& value)
    {
        if (value.kind == Kind::name)
            return value.text;
        const std::string type = types_.at(value.text);
        std::string name = type.substr(type.find('_') + 1); // without "cotan_"
        while (variables_.contains(name))
            name += "_too";
        declare(into, type, name);
        assign(into, name, value);
        return name;
    }

    Expression call(Body& into, Expression e)
    {
        std::vector<Expression> arguments;
        for (const Expression& argument : e.children) {
            if (!isStruct(argument)) {
                arguments.push_back(expression(into, argument));
                continue;
            }
            const std::string name = named(into, argument);
            for (const Variable& field : fields_.at(variables_.at(name)))
                arguments.push_back({Kind::name, name + "_" + field.name, {}});
        }
        e.children = arguments;
        return e;
    }

    Expression expression(Body& into, Expression e)
    {
        if (e.kind == Kind::member && isStruct(e.children[0]))
            return {Kind::name, named(into, e.children[0]) + "_" + e.text, {}};
        if (e.kind == Kind::call)
            return call(into, e);
        for (Expression& child : e.children)
            child = expression(into, child);
        return e;
    }

    void statement(Body& into, Statement s, bool last)
    {
        using S = Statement::Kind;
        if (s.kind == S::declare && fields_.contains(s.type)) {
            if (s.name != resultName_)
                declare(into, s.type, s.name);
            if (s.hasValue)
                assign(into, s.name, s.value);
            return;
        }
        if (s.kind == S::declare)
            reserveName(s.name, false);
        if (s.kind == S::assign && isStruct(s.target))
            return assign(into, s.target.text, s.value);
        if (s.kind == S::returnValue && !resultName_.empty()) {
            if (s.value.kind != Kind::name || s.value.text != resultName_)
                assign(into, resultName_, s.value);
            s.hasValue = false;
            if (!last)
                into.push_back(s);
            return;
        }
        if (s.kind == S::assign)
            s.target = expression(into, s.target);
        if (s.hasValue)
            s.value = expression(into, s.value);
        s.body = body(s.body, false);
        into.push_back(s);
    }

    Body body(const Body& statements, bool whole)
    {
        Body result;
        for (std::size_t i = 0; i < statements.size(); ++i) {
            const std::size_t before = result.size();
            Statement s = statements[i];
            const std::vector<std::string> comments = std::move(s.comments);
            s.comments.clear();
            statement(result, std::move(s), whole && i + 1 == statements.size());
            if (result.size() > before)
                result[before].comments = comments;
        }
        return result;
    }

    std::map<std::string, std::vector<Variable>> fields_; // of each struct, by name
    std::map<std::string, std::string> types_;            // of each function, by name
    std::map<std::string, std::string> variables_;        // struct variables and their types
    std::map<std::string, bool> names_;                   // all variables; true: a part of a struct
    std::string resultName_;
};

} // namespace

Module withoutStructs(const Module& module)
{
    Flattener flattener(module);
    Module flat;
    for (const Function& f : module.functions)
        flat.functions.push_back(flattener.function(f));
    return flat;
}

} // namespace cotan::shader_text
