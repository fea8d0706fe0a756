// Phrases of the devices beside the control (controller/devices).

#include <QCoreApplication>
#include <array>

#include "app/text/core_phrases.h"

namespace zerodrift {
namespace {

constexpr std::array<const char*, 94> devices = {{
    QT_TRANSLATE_NOOP("core", "a name or an IP address"),
    QT_TRANSLATE_NOOP("core", "a serial port such as /dev/ttyUSB0"),
    QT_TRANSLATE_NOOP("core", "an address of the camera"),
    QT_TRANSLATE_NOOP("core", "a register of the device's map"),
    QT_TRANSLATE_NOOP("core", "the kind of device %1"),
    QT_TRANSLATE_NOOP("core", "a control"),
    QT_TRANSLATE_NOOP("core", "a device to read"),
    QT_TRANSLATE_NOOP("core", "the signal of device %1"),
    QT_TRANSLATE_NOOP("core", "one topic, without the wildcards + and #"),
    QT_TRANSLATE_NOOP("core", "a topic, or topic#/path for a value in a JSON message"),
    QT_TRANSLATE_NOOP("core", "after # a JSON pointer such as /sensors/0/temperature"),
    QT_TRANSLATE_NOOP("core", "%1: the device says that it has no value"),
    QT_TRANSLATE_NOOP("core", "%1: a message is no number"),
    QT_TRANSLATE_NOOP("core", "%1: a message is no JSON"),
    QT_TRANSLATE_NOOP("core", "%1: a message has nothing at this path"),
    QT_TRANSLATE_NOOP("core", "%1: a message has something other than a number at this path"),
    QT_TRANSLATE_NOOP("core", "%1: a message is larger than 1 MB"),
    QT_TRANSLATE_NOOP("core", "%1: a retained message is not used, because its age is unknown"),
    QT_TRANSLATE_NOOP("core", "%1: the broker does not let this user read the topic"),
    QT_TRANSLATE_NOOP("core", "%1 (%2 times)"),
    QT_TRANSLATE_NOOP("core", "broker %1:%2"),
    QT_TRANSLATE_NOOP(
        "core", "no TLS connection: the broker's certificate is not of the authority given, or it does not speak TLS"),
    QT_TRANSLATE_NOOP("core", "the answer is not MQTT"),
    QT_TRANSLATE_NOOP("core", "the name of the host is not known"),
    QT_TRANSLATE_NOOP("core", "user and password go to the broker unencrypted, because TLS is off"),
    QT_TRANSLATE_NOOP("core", "the broker refuses user or password"),
    QT_TRANSLATE_NOOP("core", "the connection to the broker was lost and opened anew"),
    QT_TRANSLATE_NOOP("core", "The mode of the file %1"),
    QT_TRANSLATE_NOOP("core", "0600, so that its owner alone may read it"),
    QT_TRANSLATE_NOOP("core", "a text"),
    QT_TRANSLATE_NOOP("core", "a text in quotation marks"),
    QT_TRANSLATE_NOOP("core", "not a text"),
    QT_TRANSLATE_NOOP("core", "its text is not repeated"),
    QT_TRANSLATE_NOOP("core", "another kind of JSON"),
    QT_TRANSLATE_NOOP("core", "the address of device %1"),
    QT_TRANSLATE_NOOP("core", "an address without a user, who is in credentials_file"),
    QT_TRANSLATE_NOOP("core", "an address such as http://host:5000/"),
    QT_TRANSLATE_NOOP("core", "http: this program was built without https"),
    QT_TRANSLATE_NOOP("core", "data item %1 of %2"),
    QT_TRANSLATE_NOOP("core", "missing"),
    QT_TRANSLATE_NOOP("core", "one of the ids %1"),
    QT_TRANSLATE_NOOP("core", "the name of several"),
    QT_TRANSLATE_NOOP("core", "a condition"),
    QT_TRANSLATE_NOOP("core", "a data item with a number"),
    QT_TRANSLATE_NOOP("core", "in %1"),
    QT_TRANSLATE_NOOP("core", "no server answers there"),
    QT_TRANSLATE_NOOP("core",
                      "no TLS connection: the agent's certificate is not of the authority given, or it is not https"),
    QT_TRANSLATE_NOOP("core", "the agent closed the connection before its answer was whole"),
    QT_TRANSLATE_NOOP("core", "it is longer than %1 MB"),
    QT_TRANSLATE_NOOP("core", "the agent refuses user or password"),
    QT_TRANSLATE_NOOP("core", "the agent refers to another address, %1"),
    QT_TRANSLATE_NOOP("core", "HTTP status %1"),
    QT_TRANSLATE_NOOP("core", "it is no XML: %1"),
    QT_TRANSLATE_NOOP("core", "the agent reports \"%1\""),
    QT_TRANSLATE_NOOP("core", "it is <%1> instead of <%2>"),
    QT_TRANSLATE_NOOP("core", "%1: the agent states no unit, and its values are taken as they are"),
    QT_TRANSLATE_NOOP("core", "the agent has restarted, and its data items were read again"),
    QT_TRANSLATE_NOOP("core", "the agent keeps restarting"),
    QT_TRANSLATE_NOOP("core", "%1: an answer of the agent lacks the data item"),
    QT_TRANSLATE_NOOP("core", "%1: a value is no number"),
    QT_TRANSLATE_NOOP("core", "user and password go to the agent unencrypted, because it is not https"),
    // The profile.
    QT_TRANSLATE_NOOP("core", "a time from 0.01 to 3600 s"),
    QT_TRANSLATE_NOOP("core", "a map of its registers"),
    QT_TRANSLATE_NOOP("core", "a name that no other device has"),
    QT_TRANSLATE_NOOP("core", "one control only; this profile has another one"),
    QT_TRANSLATE_NOOP("core", "a control: modbus-tcp, modbus-rtu or manual"),
    QT_TRANSLATE_NOOP("core", "the id of one of the devices"),
    QT_TRANSLATE_NOOP("core", "the control: modbus-tcp, modbus-rtu or manual, here or among the devices"),
    QT_TRANSLATE_NOOP("core", "%1:%2, unit %3"),
    QT_TRANSLATE_NOOP("core", "%1, unit %2"),
    QT_TRANSLATE_NOOP("core", "an address that is not that of %1"),
    QT_TRANSLATE_NOOP("core", "the control"),
    QT_TRANSLATE_NOOP("core", "which signal of device %1 it is"),
    QT_TRANSLATE_NOOP("core", "the id of one of the devices that are read"),
    QT_TRANSLATE_NOOP("core", "a signal that is not %1 already"),
    QT_TRANSLATE_NOOP("core", "a channel that no other sensor has"),
    QT_TRANSLATE_NOOP("core", "the device that reads it: a manual control reads nothing"),
    // Reading.
    QT_TRANSLATE_NOOP("core", "signal %1"),
    QT_TRANSLATE_NOOP("core", "[1] to [%1]"),
    QT_TRANSLATE_NOOP("core", "%1: %2 of %3 rounds were not answered"),
    QT_TRANSLATE_NOOP("core", "device %1 does not answer: %2"),
    QT_TRANSLATE_NOOP("core", "displacement probes"),
    QT_TRANSLATE_NOOP("core", "another program has the serial port"),
    QT_TRANSLATE_NOOP("core", "a kind of device without a reader"),
    // A control without a link.
    QT_TRANSLATE_NOOP("core", "a manual control"),
    QT_TRANSLATE_NOOP("core", "a control with a link"),
    QT_TRANSLATE_NOOP("core", "the link to the control"),
    QT_TRANSLATE_NOOP("core", "the switch's state was not said"),
    QT_TRANSLATE_NOOP("core", "A test offset"),
    QT_TRANSLATE_NOOP("core", "a test offset"),
    QT_TRANSLATE_NOOP("core", "the control's check value"),
    QT_TRANSLATE_NOOP("core", "a table with the check value %1"),
    QT_TRANSLATE_NOOP("core", "reading the active table"),
    QT_TRANSLATE_NOOP("core", "going back to a former table"),
}};

}  // namespace

std::span<const char* const> phrases_of_devices() {
  return devices;
}

}  // namespace zerodrift
