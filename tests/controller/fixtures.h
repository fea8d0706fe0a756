#pragma once
// What the tests of the controller begin with: a connection, a table, the text of an end.

#include <memory>
#include <string>

#include "core/compensation/table.h"
#include "core/controller/modbus_machine.h"

namespace zerodrift::controller {

std::unique_ptr<ModbusMachine> open(const Profile& profile);
/// "done", or what went wrong.
std::string text_of(const Status& status);
/// Two axes, terms and points; `coefficient` of T1 in Z, um/K.
compensation::Table sample_table(double coefficient = 2.0);

}  // namespace zerodrift::controller
