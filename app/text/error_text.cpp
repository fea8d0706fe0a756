#include "app/text/error_text.h"

#include <QCoreApplication>
#include <array>

namespace zerodrift {
namespace {

struct Row {
  ErrorCode code;
  const char* sentence;
  const char* remedy;
};

#define SAY(code, sentence, remedy)                                                             \
  Row {                                                                                         \
    ErrorCode::code, QT_TRANSLATE_NOOP("errors", sentence), QT_TRANSLATE_NOOP("errors", remedy) \
  }

constexpr std::array rows = {
    SAY(cancelled, "The work was cancelled.", "Nothing was changed; start it again when you are ready."),
    SAY(internal, "Something unexpected happened inside the program ({detail}).",
        "Nothing was lost; please send the log to support."),
    SAY(file_not_found, "The file {file} does not exist.", "Check the name and the folder."),
    SAY(file_unreadable, "The file {file} cannot be read ({detail}).", "Check that it is a file you may read."),
    SAY(file_not_writable, "The file {file} cannot be written ({detail}).",
        "Choose a folder that exists and that you may write to."),
    SAY(file_too_large, "The file {file} is larger ({size} bytes) than the program accepts ({limit} bytes).",
        "Cut it into shorter recordings."),
    SAY(disk_full, "The disk is full: {file} could not be written.", "Free some space; what was stored is intact."),
    SAY(csv_empty, "{file} holds no rows.", "It needs a header line and at least one line of numbers."),
    SAY(csv_bad_header, "{file}: column {column} of the header is \"{found}\", expected {expected}.",
        "Correct the header or give a header map."),
    SAY(csv_cell_count, "{file}, line {line}: {found} cells where the header has {expected}.",
        "Check the line for a missing separator or a decimal comma."),
    SAY(csv_bad_number, "{file}, line {line}, column {column}: \"{found}\" is not a number.",
        "Use a decimal point; leave the cell empty if the sample is missing."),
    SAY(csv_time_order, "{file}, line {line}: the time \"{found}\" does not come after the line before.",
        "time_s must be there in every line and increase."),
    SAY(json_syntax, "{file}, line {line}, column {column}: not valid JSON ({detail}).", "Correct the file there."),
    SAY(json_missing_key, "{file}: \"{key}\" is missing; expected {expected}.", "Add the key."),
    SAY(json_bad_value, "{file}: \"{key}\" is {found}; expected {expected}.", "Correct the value."),
    SAY(wrong_format, "{file} is {found}; expected {expected}.", "Choose another file."),
    SAY(channel_missing, "There is no channel {channel}; there are: {available}.",
        "Check the name, or rename the column with a header map."),
    SAY(not_enough_data, "Too little data: {what} has {found}, {needed} needed.", "Record longer or choose fewer."),
    SAY(no_variation, "{what} never changes, so nothing can be learned from it.",
        "Check the sensor, or leave it out; a run must warm the machine."),
    SAY(bad_argument, "{what} is \"{found}\"; expected {expected}.", "Correct it and try again."),
    SAY(data_does_not_fit, "{what} does not fit: found {found}, expected {expected}.",
        "Check that both belong to the same machine."),
    SAY(image_unreadable, "The image {file} cannot be read ({detail}).", "Check the file; PNG and JPEG are accepted."),
    SAY(image_size, "The image {file} is {found} pixels; the template is {expected}.",
        "Use images from the same camera with the same settings."),
    SAY(region_outside_image, "The region {region} is not inside the image {file} ({size}).",
        "Give the region as X,Y,W,H in pixels inside the image."),
    SAY(template_without_texture, "The region of the template {file} shows nothing that could be followed.",
        "Choose a region with the target in it; check light and focus."),
    SAY(camera_unreachable, "The camera at {url} does not answer ({detail}).",
        "Check that it is switched on, connected and the address is right."),
    SAY(camera_silent, "The camera at {url} has sent no picture for {seconds} s.",
        "Check cable and power; the run goes on and waits for it."),
    SAY(camera_frozen, "The camera at {url} has sent the same picture for {seconds} s: it is frozen.",
        "Restart the camera; no error was measured meanwhile."),
    SAY(target_refused, "The target was not measured: {reason}.", "Clear the view, check light and focus."),
    SAY(calibration_refused, "The calibration is refused: {reason}.",
        "Measure again with positions further apart, not on one line."),
    SAY(job_not_a_job, "{file} is not a Zerodrift job.", "Choose a file that Zerodrift made."),
    SAY(job_newer, "{file} was made by a newer version (format {found}, this program knows {expected}).",
        "Update Zerodrift; the file was not touched."),
    SAY(job_damaged, "The job {file} is damaged ({detail}).",
        "Open the latest backup; what can be read was left as it is."),
    SAY(job_busy, "The job {file} is open in another program.", "Close it there first."),
    SAY(step_blocked, "The step {step} cannot run yet: it needs {needs}.", "Do that step first."),
    SAY(port_unavailable, "Port {port} at {host} cannot be served ({detail}).",
        "Choose another port, or 0 for any free one."),
    SAY(machine_unreachable, "No connection to the controller at {host}, port {port} ({detail}).",
        "Check cable, address and port, and that the controller's Modbus server is on."),
    SAY(machine_silent, "The controller did not answer within {timeout_ms} ms ({what}).",
        "Check the connection and the unit number; the link is opened anew by itself."),
    SAY(machine_link_lost, "The connection to the controller was lost ({what}, {detail}).",
        "Check the cable; the link is opened anew by itself."),
    SAY(machine_bad_reply,
        "The controller's answer does not belong to the question ({what}: {detail}); it was not used.",
        "Check for a second master or a faulty gateway."),
    SAY(machine_busy, "The controller is busy ({what}).", "Wait a little and try again."),
    SAY(machine_exception, "The controller refused {what} (Modbus exception {exception}).",
        "Check the register map against the controller's manual."),
    SAY(machine_unsupported, "The controller does not fit: {what} is {found}, expected {expected}.",
        "Check profile and register map."),
    SAY(machine_register_unknown, "The register map {map} has no register \"{register}\".",
        "Add it to the map, or switch off the function that needs it."),
    SAY(machine_not_ready, "The machine is not ready for {what}: {reason}.", "Put it right and try again."),
    SAY(target_partly_covered, "The target before camera {view} is partly occluded: {percent} % of it is measured.",
        "The numbers hold, with their uncertainty; wipe the target at the next stop."),
    SAY(sensor_dead, "The temperature sensor {sensor} gives no value.",
        "Check its plug and cable, or leave it out of the model."),
    SAY(sensor_stuck, "The temperature sensor {sensor} has not moved for {seconds} s: it is stuck.",
        "Check it, or leave it out of the model."),
    SAY(interlock_compensation_on, "Not allowed while the compensation is ON: {operation}.",
        "Switch the compensation off first; data measured with it on would be wrong."),
    SAY(interlock_compensation_off, "Not allowed while the compensation is OFF: {operation}.",
        "Switch the compensation on first."),
    SAY(limit_exceeded, "{what} is {found}, beyond the limit of {limit}.",
        "Nothing was written; check the model or the limit."),
    SAY(not_confirmed, "{operation} was not confirmed; nothing was written.", "Confirm it, or use --yes."),
    SAY(upload_read_back, "Register {register} reads back {read} instead of {written}.",
        "Nothing was activated; check the link and the register map."),
    SAY(upload_rejected, "The controller rejected the table: {reason}.",
        "Nothing was activated; the old table is active."),
    SAY(upload_restored, "The upload failed ({reason}); the old table was restored and read back.",
        "Find the cause, then upload again."),
    SAY(upload_restore_failed,
        "The upload failed ({reason}) AND the old table could not be restored ({detail}). The machine's table is not "
        "known.",
        "Do not machine parts. Switch the compensation off at the controller, then use rollback."),
    SAY(sign_check_failed, "The sign check failed on axis {axis}: commanded {commanded_um} um, seen in um: {seen_um}.",
        "Nothing was written; check the axis direction and the calibration."),
};
#undef SAY

/// Puts the context into the braces; a fact that is not known shows as a dash.
QString filled(const char* pattern, const Error& error) {
  const QString source = QCoreApplication::translate("errors", pattern);
  QString out;
  for (qsizetype i = 0; i < source.size(); ++i) {
    const qsizetype end = source[i] == u'{' ? source.indexOf(u'}', i) : -1;
    if (end < 0) {
      out += source[i];
      continue;
    }
    const auto fact = error.context.find(source.mid(i + 1, end - i - 1).toStdString());
    out += fact == error.context.end() ? QStringLiteral("-") : QString::fromStdString(fact->second);
    i = end;
  }
  return out;
}

}  // namespace

ErrorText textOf(const Error& error) {
  for (const Row& row : rows) {
    if (row.code == error.code) return {filled(row.sentence, error), filled(row.remedy, error)};
  }
  return {QString::fromStdString(describe(error)), {}};
}

QString lineOf(const Error& error) {
  const ErrorText text = textOf(error);
  return text.remedy.isEmpty() ? text.sentence : text.sentence + QStringLiteral(" ") + text.remedy;
}

}  // namespace zerodrift
