// The text form of commands: what is written reads back the same, and what is wrong is said with
// its place.
#include "app/session/commands/command.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/session/commands/command_table.h"
#include "engine/core/check.h"
#include "tests/unit/session/session_cases.h"

namespace pedicel::app {
namespace {

using ::testing::HasSubstr;

std::optional<Command> parse(const std::string& line, std::string* errors = nullptr) {
  Diagnostics diagnostics;
  const auto command = parse_command(line, {"script", 7, 1}, diagnostics);
  if (errors) *errors = diagnostics.text();
  return command;
}

std::string error_of(const std::string& line) {
  std::string errors;
  EXPECT_FALSE(parse(line, &errors).has_value()) << line;
  return errors;
}

TEST(Command, ReadsArgumentsInOrderAndByName) {
  const auto command = parse("add fruit p berry \"long stem\" 0.5 0.01 bend=0.3");
  ASSERT_TRUE(command.has_value());
  EXPECT_EQ(command->verb(), "add fruit");
  EXPECT_EQ(command->word("stem"), "long stem");
  EXPECT_EQ(command->number("at"), 0.5);
  EXPECT_EQ(command->number_or("bend", 0.0), 0.3);
  EXPECT_FALSE(command->has("stretch"));
  EXPECT_EQ(*command, *parse("add fruit p berry at=0.5 stem=\"long stem\" radius=0.01 bend=0.3"));
}

TEST(Command, TextReadsBackExactly) {
  const std::vector<Command> commands = {
      {"draw stem",
       {{"plant", "a b"},
        {"stem", "s"},
        {"points", std::vector<Vec3>{{0.1, 1.0 / 3.0, -2e-17}, {1, 2, 3}}},
        {"radius", std::vector<double>{0.1 + 0.2, 1e-3}}}},
      {"add plant", {{"plant", "q"}, {"text", "a: \"x\"\nb: c\\d # e\n"}}},
      {"set", {{"key", "rods.newton_iterations"}, {"value", "6"}}},
      {"move point", {{"plant", "p"}, {"stem", "#1"}, {"point", 3}, {"to", Vec3(1, 2, 3)}}},
      {"undo", {}},
  };
  for (const Command& command : commands) {
    const auto back = parse(command.text());
    ASSERT_TRUE(back.has_value()) << command.text();
    EXPECT_EQ(*back, command) << command.text();
  }
}

TEST(Command, SaysWhatIsWrongAndWhere) {
  EXPECT_EQ(error_of("move point p stem x 0,0,0"),
            "script:7:19: error: move point: point is \"x\", expected a whole number");
  EXPECT_THAT(error_of("move point p stem 1 0,0"), HasSubstr("expected a point x,y,z"));
  EXPECT_THAT(error_of("move point p stem 1.5 0,0,0"), HasSubstr("7:19: error"));
  EXPECT_THAT(error_of("move point p stem 1"),
              HasSubstr("to is missing, expected: move point PLANT STEM POINT TO"));
  EXPECT_THAT(error_of("undo now"), HasSubstr("\"now\" is too much"));
  EXPECT_THAT(error_of("draw flower p"),
              HasSubstr("unknown command \"draw\", expected one of: draw stem"));
  EXPECT_THAT(error_of("add fruit p f s 1 0.01 colour=red"),
              HasSubstr("7:24: error: add fruit: unknown argument \"colour\""));
  EXPECT_THAT(error_of("add fruit p f s 1 0.01 radius=2"), HasSubstr("radius is given twice"));
  EXPECT_THAT(error_of("add plant p \"open"), HasSubstr("a quote is left open"));
  EXPECT_THAT(error_of("set material p density nan"), HasSubstr("expected a number"));
}

TEST(Command, BuiltOnesAreCheckedAsTextIs) {
  EXPECT_THROW(Command("fly", {}), UsageError);
  EXPECT_THROW(Command("undo", {{"what", 1}}), UsageError);
  EXPECT_THROW(Command("set length", {{"plant", "p"}, {"stem", "s"}}), UsageError);
  EXPECT_THROW(Command("set length", {{"plant", "p"}, {"stem", "s"}, {"length", "long"}}),
               UsageError);
}

TEST(Command, DragsMergeByWhatTheyName) {
  const auto key = [](const char* line) { return parse(line)->merge_key(); };
  EXPECT_EQ(key("move point p s 1 0,0,0"), key("move point p s 1 1,0,0"));
  EXPECT_NE(key("move point p s 1 0,0,0"), key("move point p s 2 0,0,0"));
  EXPECT_EQ(key("set rods.tolerance 1e-4"), key("set rods.tolerance 1e-5"));
  EXPECT_NE(key("set rods.tolerance 1e-4"), key("set coupling.friction 1e-4"));
}

TEST(Command, EveryOneIsDescribed) {
  for (const CommandDescription& one : command_table()) {
    EXPECT_FALSE(one.sentence.empty()) << one.verb;
    EXPECT_EQ(find_command(one.verb), &one) << one.verb << " is there twice";
    for (const ArgumentDescription& argument : one.arguments)
      EXPECT_FALSE(argument.sentence.empty()) << one.verb << ' ' << argument.name;
  }
}

// A description without a handler does not compile.
static_assert(!std::is_default_constructible_v<CommandHandler>);
static_assert(!std::is_constructible_v<CommandHandler, std::nullptr_t>);
static_assert(!std::is_default_constructible_v<CommandDescription>);

TEST(Command, EveryOneHasOneHandlerOfItsScope) {
  for (const CommandDescription& one : command_table()) {
    const bool is_of_document = one.scope == Scope::document;
    EXPECT_EQ(one.handler.on_document() != nullptr, is_of_document) << one.verb;
    EXPECT_EQ(one.handler.on_session() != nullptr, !is_of_document) << one.verb;
    EXPECT_TRUE(is_of_document || !one.complete) << one.verb;
  }
}

TEST(Command, WhatNobodyDoesIsRefused) {
  Session session(waiting());
  const std::uint64_t before = session.document().state_hash();
  EXPECT_EQ(session.run(Command()).text, ": no such command");
  EXPECT_FALSE(session.run(Command()).ok);
  EXPECT_FALSE(session.run_text("fly").ok);
  Document document = session.document();
  EXPECT_THROW(apply_command(document, Command("play", {})), UsageError);
  EXPECT_EQ(session.document().state_hash(), before);
  EXPECT_TRUE(session.log().empty());
}

}  // namespace
}  // namespace pedicel::app
