#include "app/text/error_text.h"

#include <QCoreApplication>
#include <array>

#include "app/text/core_text.h"
#include "app/text/window_remedies.h"

namespace zerodrift {
namespace {

struct Row {
  ErrorCode code;
  const char* sentence;
  const char* remedy;
};

constexpr std::array rows = {
    Row{ErrorCode::cancelled, QT_TRANSLATE_NOOP("errors", "The work was cancelled."),
        QT_TRANSLATE_NOOP("errors", "What was finished until then is kept; start it again when you are ready.")},
    Row{ErrorCode::internal,
        QT_TRANSLATE_NOOP("errors", "Something unexpected happened inside the program ({detail})."),
        QT_TRANSLATE_NOOP("errors", "Nothing was lost; please send the log to support.")},
    Row{ErrorCode::file_not_found, QT_TRANSLATE_NOOP("errors", "The file {file} does not exist."),
        QT_TRANSLATE_NOOP("errors", "Check the name and the folder.")},
    Row{ErrorCode::file_unreadable, QT_TRANSLATE_NOOP("errors", "The file {file} cannot be read ({detail})."),
        QT_TRANSLATE_NOOP("errors", "Check that it is a file you may read.")},
    Row{ErrorCode::file_not_writable, QT_TRANSLATE_NOOP("errors", "The file {file} cannot be written ({detail})."),
        QT_TRANSLATE_NOOP("errors", "Choose a folder that exists and that you may write to.")},
    Row{ErrorCode::file_too_large,
        QT_TRANSLATE_NOOP("errors",
                          "The file {file} is larger ({size} bytes) than the program accepts ({limit} bytes)."),
        QT_TRANSLATE_NOOP("errors", "Cut it into shorter recordings.")},
    Row{ErrorCode::disk_full, QT_TRANSLATE_NOOP("errors", "The disk is full: {file} could not be written."),
        QT_TRANSLATE_NOOP("errors", "Free some space; what was stored is intact.")},
    Row{ErrorCode::csv_empty, QT_TRANSLATE_NOOP("errors", "{file} holds no rows."),
        QT_TRANSLATE_NOOP("errors", "It needs a header line and at least one line of numbers.")},
    Row{ErrorCode::csv_bad_header,
        QT_TRANSLATE_NOOP("errors", "{file}: column {column} of the header is \"{found}\", expected {expected}."),
        QT_TRANSLATE_NOOP("errors", "Correct the header or give a header map.")},
    Row{ErrorCode::csv_cell_count,
        QT_TRANSLATE_NOOP("errors", "{file}, line {line}: {found} cells where the header has {expected}."),
        QT_TRANSLATE_NOOP("errors", "Check the line for a missing separator or a decimal comma.")},
    Row{ErrorCode::csv_bad_number,
        QT_TRANSLATE_NOOP("errors", "{file}, line {line}, column {column}: \"{found}\" is not a number."),
        QT_TRANSLATE_NOOP("errors",
                          "Correct it; if the sample is missing, leave the cell empty or add the word to \"missing\" "
                          "in a header map (--map).")},
    Row{ErrorCode::column_unclear,
        QT_TRANSLATE_NOOP("errors", "{file}, line {line}, column {column}: found {found}; expected {expected}."),
        QT_TRANSLATE_NOOP("errors", "Correct it there, or say with a column map (--map) what the column holds.")},
    Row{ErrorCode::csv_time_order,
        QT_TRANSLATE_NOOP("errors", "{file}, line {line}: the time \"{found}\" does not come after the line before."),
        QT_TRANSLATE_NOOP(
            "errors",
            "Times must be there in every line and increase: correct the order of the lines, or take the line out.")},
    Row{ErrorCode::workbook_formula,
        QT_TRANSLATE_NOOP("errors", "{file}, row {line}, column {column}: the formula there has no value."),
        QT_TRANSLATE_NOOP("errors", "Open the workbook in a spreadsheet program, save it, and import it again.")},
    Row{ErrorCode::text_encoding,
        QT_TRANSLATE_NOOP("errors", "{file}, line {line}: there are bytes that mean nothing in {encoding}."),
        QT_TRANSLATE_NOOP("errors", "Save the file as UTF-8, or say its \"encoding\" in a header map.")},
    Row{ErrorCode::quote_open,
        QT_TRANSLATE_NOOP("errors", "{file}, line {line}: a quotation mark opens and never closes."),
        QT_TRANSLATE_NOOP("errors", "Close it or take it out.")},
    Row{ErrorCode::number_ambiguous,
        QT_TRANSLATE_NOOP("errors",
                          "{file}, line {line}, column {column}: \"{found}\" may have a decimal comma or group "
                          "thousands, and no other number in the file decides it."),
        QT_TRANSLATE_NOOP("errors", "Say \"decimal\": \",\" or \"decimal\": \".\" in a header map.")},
    Row{ErrorCode::numbers_mixed,
        QT_TRANSLATE_NOOP("errors",
                          "{file}, line {line}, column {column}: \"{found}\" and \"{other}\" (line {other_line}) do "
                          "not have the same decimal sign."),
        QT_TRANSLATE_NOOP("errors", "Write one of them otherwise, or say \"decimal\" in a header map.")},
    Row{ErrorCode::two_tables,
        QT_TRANSLATE_NOOP("errors", "{file} holds two tables: one at line {line}, one at line {other_line}."),
        QT_TRANSLATE_NOOP("errors", "Save each in a file of its own.")},
    Row{ErrorCode::header_repeated, QT_TRANSLATE_NOOP("errors", "{file}, line {line}: the header stands here again."),
        QT_TRANSLATE_NOOP("errors", "The rows after it are read on.")},
    Row{ErrorCode::line_passed_over,
        QT_TRANSLATE_NOOP("errors", "{file}, line {line}: \"{found}\" is no row of the table and was passed over."),
        QT_TRANSLATE_NOOP("errors", "Correct the line if it should be one.")},
    Row{ErrorCode::table_no_header,
        QT_TRANSLATE_NOOP("errors", "{file} has no header: line {line}, its first, holds numbers."),
        QT_TRANSLATE_NOOP(
            "errors",
            "Name its columns by their places, #1, #2 and so on, under \"columns\" in a header map (--map).")},
    Row{ErrorCode::map_column_missing,
        QT_TRANSLATE_NOOP("errors",
                          "{file} has no column \"{column}\", which the header map names; there are: {available}."),
        QT_TRANSLATE_NOOP("errors",
                          "Correct the header map; a column may also be named by its place, for example #3.")},
    Row{ErrorCode::unit_conflict,
        QT_TRANSLATE_NOOP("errors",
                          "{file}, column {column}: the values are in {found}, which does not agree with {expected}."),
        QT_TRANSLATE_NOOP("errors", "Correct the unit, the scale or the channel in the header map.")},
    Row{ErrorCode::time_missing, QT_TRANSLATE_NOOP("errors", "{file} has no column of times; there are: {available}."),
        QT_TRANSLATE_NOOP("errors",
                          "Name it under \"time\" in a header map (--map): its \"column\" and its \"unit\".")},
    Row{ErrorCode::time_unit_unknown,
        QT_TRANSLATE_NOOP("errors", "{file}, column {column}: the times ({found} first) say no unit."),
        QT_TRANSLATE_NOOP("errors",
                          "Give \"unit\" under \"time\" in a header map (--map): s, ms, us, ns, min, h or d.")},
    Row{ErrorCode::time_ambiguous,
        QT_TRANSLATE_NOOP(
            "errors",
            "{file}, line {line}, column {column}: in \"{found}\" day, month and year may be in more than one order."),
        QT_TRANSLATE_NOOP("errors",
                          "Give \"format\" under \"time\" in a header map (--map), for example %d/%m/%Y %H:%M:%S.")},
    Row{ErrorCode::time_unreadable,
        QT_TRANSLATE_NOOP("errors",
                          "{file}, line {line}, column {column}: \"{found}\" is no time of the form the column has."),
        QT_TRANSLATE_NOOP("errors",
                          "Correct the line, or give \"format\" under \"time\" in a header map (--map), for example "
                          "%d.%m.%Y %H:%M:%S.")},
    Row{ErrorCode::time_epoch,
        QT_TRANSLATE_NOOP(
            "errors",
            "The times in column {column} are {unit} since 1970, by their size; the recording starts {start}."),
        QT_TRANSLATE_NOOP("errors", "If they are not, give the unit in a header map.")},
    Row{ErrorCode::time_start_unknown,
        QT_TRANSLATE_NOOP("errors",
                          "In column {column} \"{found}\" may be more than one date; times do not depend on it, and no "
                          "date is kept."),
        QT_TRANSLATE_NOOP("errors", "Give the format in a header map to keep the date.")},
    Row{ErrorCode::time_summer_end,
        QT_TRANSLATE_NOOP("errors",
                          "{file}, line {line}: the local clock goes back by an hour, as at the end of summer time."),
        QT_TRANSLATE_NOOP(
            "errors",
            "The rows from there on count an hour later; correct the file if the clock was set for another reason.")},
    Row{ErrorCode::time_hour_missing,
        QT_TRANSLATE_NOOP("errors", "{file}, line {line}: an hour is missing, as at the beginning of summer time."),
        QT_TRANSLATE_NOOP("errors", "It counts as a gap; give times with a zone if the clock was set forward.")},
    Row{ErrorCode::time_midnight,
        QT_TRANSLATE_NOOP("errors", "{file}, line {line}: the time of day starts again; a day is counted on."),
        QT_TRANSLATE_NOOP("errors", "Give a column with dates if it was more than one day.")},
    Row{ErrorCode::time_repeated,
        QT_TRANSLATE_NOOP("errors",
                          "{file}: {count} rows repeat the row before them word for word, the first in line {line}; "
                          "they were left out."),
        QT_TRANSLATE_NOOP("errors", "Nothing need be done.")},
    Row{ErrorCode::samples_missing, QT_TRANSLATE_NOOP("errors", "Column {column}: read as missing samples: {words}."),
        QT_TRANSLATE_NOOP("errors", "Check the sensor if they should be there.")},
    Row{ErrorCode::column_proposed,
        QT_TRANSLATE_NOOP("errors", "Column {column} was read as {channel}; it may be {proposal}."),
        QT_TRANSLATE_NOOP("errors", "Say so in a header map if it is.")},
    Row{ErrorCode::column_converted,
        QT_TRANSLATE_NOOP("errors", "Column {column} states {unit}; it was converted into {channel}."),
        QT_TRANSLATE_NOOP("errors", "Give the unit in a header map if that is wrong.")},
    Row{ErrorCode::sentinel_suspected,
        QT_TRANSLATE_NOOP("errors",
                          "Column {column} holds {found} in {count} rows, which may stand for a missing sample."),
        QT_TRANSLATE_NOOP("errors", "If so, add it to \"missing\" in a header map.")},
    Row{ErrorCode::json_syntax,
        QT_TRANSLATE_NOOP("errors", "{file}, line {line}, column {column}: not valid JSON ({detail})."),
        QT_TRANSLATE_NOOP("errors", "Correct the file there.")},
    Row{ErrorCode::json_missing_key, QT_TRANSLATE_NOOP("errors", "{file}: \"{key}\" is missing; expected {expected}."),
        QT_TRANSLATE_NOOP("errors", "Add this entry, if it is the right file.")},
    Row{ErrorCode::json_bad_value, QT_TRANSLATE_NOOP("errors", "{file}: \"{key}\" is {found}; expected {expected}."),
        QT_TRANSLATE_NOOP("errors", "Correct the value.")},
    Row{ErrorCode::wrong_format, QT_TRANSLATE_NOOP("errors", "{file} is {found}; expected {expected}."),
        QT_TRANSLATE_NOOP("errors", "Choose another file.")},
    Row{ErrorCode::channel_missing,
        QT_TRANSLATE_NOOP("errors", "There is no channel {channel}; there are: {available}."),
        QT_TRANSLATE_NOOP("errors", "Check the name, or rename the column with a header map.")},
    Row{ErrorCode::not_enough_data,
        QT_TRANSLATE_NOOP("errors", "Too little data: {what} has {found}, {needed} needed."),
        QT_TRANSLATE_NOOP("errors", "Give more of it: record longer, or ask for less.")},
    Row{ErrorCode::no_variation,
        QT_TRANSLATE_NOOP("errors", "{what} never changes, so nothing can be learned from it."),
        QT_TRANSLATE_NOOP("errors", "Check the sensor, or leave it out; a run must warm the machine.")},
    Row{ErrorCode::bad_argument, QT_TRANSLATE_NOOP("errors", "{what} is \"{found}\"; expected {expected}."),
        QT_TRANSLATE_NOOP("errors", "Correct it and try again.")},
    Row{ErrorCode::data_does_not_fit,
        QT_TRANSLATE_NOOP("errors", "{what} does not fit: found {found}, expected {expected}."),
        QT_TRANSLATE_NOOP("errors", "Check the units, and that all of it is of one machine.")},
    Row{ErrorCode::image_unreadable, QT_TRANSLATE_NOOP("errors", "The image {file} cannot be read ({detail})."),
        QT_TRANSLATE_NOOP("errors", "Check the file; PNG, JPEG, BMP and TIFF are accepted.")},
    Row{ErrorCode::image_size,
        QT_TRANSLATE_NOOP("errors", "The image {file} is {found} pixels; the template is {expected}."),
        QT_TRANSLATE_NOOP("errors", "Use images from the same camera with the same settings.")},
    Row{ErrorCode::region_outside_image,
        QT_TRANSLATE_NOOP("errors", "The region {region} is not inside the image {file} ({size})."),
        QT_TRANSLATE_NOOP("errors", "Give the region as X,Y,W,H in pixels inside the image.")},
    Row{ErrorCode::template_without_texture,
        QT_TRANSLATE_NOOP("errors", "The region of the template {file} shows nothing that could be followed."),
        QT_TRANSLATE_NOOP("errors", "Choose a region with the target in it; check light and focus.")},
    Row{ErrorCode::pattern_repeats,
        QT_TRANSLATE_NOOP("errors",
                          "The pattern of {file} repeats itself beyond the region: one period further it looks "
                          "the same, and a shift by one period could not be told from none."),
        QT_TRANSLATE_NOOP("errors", "Choose a region with the edge of the pattern or a mark in it.")},
    Row{ErrorCode::camera_unreachable, QT_TRANSLATE_NOOP("errors", "The camera at {url} does not answer ({detail})."),
        QT_TRANSLATE_NOOP("errors", "Check that it is switched on, connected and the address is right.")},
    Row{ErrorCode::camera_silent,
        QT_TRANSLATE_NOOP("errors", "The camera at {url} has sent no picture for {seconds} s."),
        QT_TRANSLATE_NOOP("errors", "Check cable and power; the run goes on and waits for it.")},
    Row{ErrorCode::camera_frozen,
        QT_TRANSLATE_NOOP("errors", "The camera at {url} has sent the same picture for {seconds} s: it is frozen."),
        QT_TRANSLATE_NOOP("errors", "Restart the camera; no error was measured meanwhile.")},
    Row{ErrorCode::camera_exchanged,
        QT_TRANSLATE_NOOP("errors", "The camera at {url} has the serial number {found}; it was {expected} before."),
        QT_TRANSLATE_NOOP("errors", "Connect the camera that was there before, or connect anew and calibrate.")},
    Row{ErrorCode::camera_ambiguous,
        QT_TRANSLATE_NOOP("errors",
                          "{url} does not say which camera: those with the serial numbers {found} are there."),
        QT_TRANSLATE_NOOP("errors", "Write the serial number of one of them into the profile: aravis:SERIAL.")},
    Row{ErrorCode::camera_setting,
        QT_TRANSLATE_NOOP("errors", "The camera at {url} does not take {what} {expected} ({found})."),
        QT_TRANSLATE_NOOP("errors", "Write a value that the camera has into the profile, or remove the key.")},
    Row{ErrorCode::camera_format,
        QT_TRANSLATE_NOOP("errors", "The camera at {url} sends pictures as {found}, which is not read."),
        QT_TRANSLATE_NOOP("errors",
                          "Set the camera to one of the formats {expected} or another grey or Bayer format.")},
    Row{ErrorCode::target_refused, QT_TRANSLATE_NOOP("errors", "The target was not measured: {reason}."),
        QT_TRANSLATE_NOOP("errors", "Clear the view, check light and focus.")},
    Row{ErrorCode::calibration_refused, QT_TRANSLATE_NOOP("errors", "The calibration is refused: {reason}."),
        QT_TRANSLATE_NOOP(
            "errors",
            "Look at what is named; positions are in mm, apart and not on one line, each with its own picture.")},
    Row{ErrorCode::calibration_of_another_target,
        QT_TRANSLATE_NOOP("errors", "{file} was made with another target than {template} shows ({detail})."),
        QT_TRANSLATE_NOOP("errors", "Give the template and the region it was made with, or calibrate anew.")},
    Row{ErrorCode::calibration_of_another_camera,
        QT_TRANSLATE_NOOP("errors", "Camera {camera} was calibrated with {what} {expected}; now it is {found}."),
        QT_TRANSLATE_NOOP("errors", "Put it back as it was calibrated, or calibrate anew.")},
    Row{ErrorCode::job_not_a_job, QT_TRANSLATE_NOOP("errors", "{file} is not a Zerodrift job."),
        QT_TRANSLATE_NOOP("errors", "Choose a file that Zerodrift made.")},
    Row{ErrorCode::job_newer,
        QT_TRANSLATE_NOOP("errors",
                          "{file} was made by a newer version (format {found}, this program knows {expected})."),
        QT_TRANSLATE_NOOP("errors", "Update Zerodrift; the file was not touched.")},
    Row{ErrorCode::job_damaged, QT_TRANSLATE_NOOP("errors", "The job {file} is damaged ({detail})."),
        QT_TRANSLATE_NOOP("errors", "Open the latest backup; what can be read was left as it is.")},
    Row{ErrorCode::job_busy, QT_TRANSLATE_NOOP("errors", "The job {file} is open in another program."),
        QT_TRANSLATE_NOOP("errors", "Close it there first.")},
    Row{ErrorCode::step_blocked, QT_TRANSLATE_NOOP("errors", "The step {step} cannot run yet: it needs {needs}."),
        QT_TRANSLATE_NOOP("errors", "Do that step first.")},
    Row{ErrorCode::port_unavailable, QT_TRANSLATE_NOOP("errors", "Port {port} at {host} cannot be served ({detail})."),
        QT_TRANSLATE_NOOP("errors", "Choose another port, or 0 for any free one.")},
    Row{ErrorCode::machine_unreachable, QT_TRANSLATE_NOOP("errors", "No connection to {host}, port {port} ({detail})."),
        QT_TRANSLATE_NOOP("errors",
                          "Check cable, address and port, that the Modbus server, broker or agent there is on, and "
                          "user and password where it asks for them.")},
    Row{ErrorCode::machine_silent, QT_TRANSLATE_NOOP("errors", "No answer came within {timeout_ms} ms ({what})."),
        QT_TRANSLATE_NOOP("errors", "Check the connection and the unit number; the link is opened anew by itself.")},
    Row{ErrorCode::machine_link_lost, QT_TRANSLATE_NOOP("errors", "The connection was lost ({what}, {detail})."),
        QT_TRANSLATE_NOOP("errors", "Check the cable; the link is opened anew by itself.")},
    Row{ErrorCode::machine_bad_reply,
        QT_TRANSLATE_NOOP("errors", "The answer does not belong to the question ({what}: {detail}); it was not used."),
        QT_TRANSLATE_NOOP(
            "errors",
            "Check the address, and look for a second master, a faulty gateway or another server in between.")},
    Row{ErrorCode::machine_busy, QT_TRANSLATE_NOOP("errors", "The controller is busy ({what})."),
        QT_TRANSLATE_NOOP("errors", "Wait a little and try again.")},
    Row{ErrorCode::machine_gateway,
        QT_TRANSLATE_NOOP(
            "errors",
            "The gateway got no answer from the controller behind it ({what}, Modbus exception {exception})."),
        QT_TRANSLATE_NOOP(
            "errors",
            "Check the line behind the gateway, the unit number and the gateway's own timeout; the request is "
            "repeated by itself.")},
    Row{ErrorCode::machine_failed,
        QT_TRANSLATE_NOOP("errors", "The controller failed at a request, or refused it ({what}, Modbus exception 4)."),
        QT_TRANSLATE_NOOP(
            "errors",
            "If it stays, look at the controller's own messages: some refuse in this way what the state of "
            "the machine forbids.")},
    Row{ErrorCode::machine_function_missing,
        QT_TRANSLATE_NOOP("errors", "The controller does not have the Modbus function {function}, needed for {what}."),
        QT_TRANSLATE_NOOP(
            "errors",
            "Switch it on in the controller's Modbus server. Reading may use input registers (function 4) "
            "instead of holding registers (function 3) in the register map; writing more than one register "
            "needs function 16.")},
    Row{ErrorCode::machine_exception,
        QT_TRANSLATE_NOOP("errors", "The controller refused {what} (Modbus exception {exception})."),
        QT_TRANSLATE_NOOP("errors", "Check the register map against the controller's manual.")},
    Row{ErrorCode::machine_unsupported,
        QT_TRANSLATE_NOOP("errors", "The controller or device does not fit: {what} is {found}, expected {expected}."),
        QT_TRANSLATE_NOOP("errors", "Check the profile, the register map and the device's own settings.")},
    Row{ErrorCode::machine_register_unknown,
        QT_TRANSLATE_NOOP("errors", "The register map {map} has no register \"{register}\"."),
        QT_TRANSLATE_NOOP("errors", "Add it to the map, or switch off the function that needs it.")},
    Row{ErrorCode::machine_not_ready, QT_TRANSLATE_NOOP("errors", "The machine is not ready for {what}: {reason}."),
        QT_TRANSLATE_NOOP("errors", "Put it right and try again.")},
    Row{ErrorCode::device_failing,
        QT_TRANSLATE_NOOP("errors", "Device {device} does not answer, its values are missing: {reason}."),
        QT_TRANSLATE_NOOP("errors", "Check its power, its cable and its address; it is asked again by itself.")},
    Row{ErrorCode::operator_missing,
        QT_TRANSLATE_NOOP("errors", "The control of this machine has no link, and nobody is here to operate it."),
        QT_TRANSLATE_NOOP("errors", "Start this on a terminal, or give \"--operator -\" and answer each line.")},
    Row{ErrorCode::operator_declined, QT_TRANSLATE_NOOP("errors", "The operator could not do \"{request}\": {reason}."),
        QT_TRANSLATE_NOOP("errors", "Put it right at the control and start the step again.")},
    Row{ErrorCode::operator_gone, QT_TRANSLATE_NOOP("errors", "The operator does not answer any more."),
        QT_TRANSLATE_NOOP("errors", "Bring the machine to rest at its control, then start the step again.")},
    Row{ErrorCode::no_measuring_position,
        QT_TRANSLATE_NOOP(
            "errors",
            "Neither the plan nor the profile says where the errors are measured: the position of {axes} is missing."),
        QT_TRANSLATE_NOOP("errors", "Give measure_position_mm in the plan or in the profile.")},
    Row{ErrorCode::measuring_stretched,
        QT_TRANSLATE_NOOP("errors",
                          "A measurement takes longer than its period: the errors are measured every {every_s} s "
                          "instead of every {period_s} s."),
        QT_TRANSLATE_NOOP(
            "errors", "The run goes on; close other programs on this computer, or choose a longer measuring period.")},
    Row{ErrorCode::too_few_measurements,
        QT_TRANSLATE_NOOP(
            "errors", "At this pace the run will end with {expected} good measurements, at least {needed} are needed."),
        QT_TRANSLATE_NOOP("errors",
                          "Look at why measurements are refused or slow, then start again: close other programs on "
                          "this computer, clear the view, or plan a longer run.")},
    Row{ErrorCode::error_leapt,
        QT_TRANSLATE_NOOP("errors",
                          "The error in {axis} leapt by {change_um} um since the last measurement; heat can make at "
                          "most {limit_um} um of it. The measurement was refused."),
        QT_TRANSLATE_NOOP("errors",
                          "Check that the target is firm in its holder and that nothing moves the machine; a leap that "
                          "is found three times in a row is taken as a slip.")},
    Row{ErrorCode::leap_confirmed,
        QT_TRANSLATE_NOOP("errors",
                          "The error in {axis} leapt by {change_um} um and stayed there: the target or its holder has "
                          "slipped. The measurements since contain that leap."),
        QT_TRANSLATE_NOOP("errors",
                          "Fix the target and repeat the run, or leave this part of the run out of the fit.")},
    Row{ErrorCode::camera_late,
        QT_TRANSLATE_NOOP("errors",
                          "The pictures of camera {view} were older than was known when it was calibrated; {seconds} s "
                          "are waited for now."),
        QT_TRANSLATE_NOOP("errors", "The measurements hold. Check the camera's network, or calibrate anew.")},
    Row{ErrorCode::table_not_active,
        QT_TRANSLATE_NOOP("errors",
                          "The machine does not hold version {version}, the table of this job: it holds {found}."),
        QT_TRANSLATE_NOOP("errors", "Write it, or bring it back in the history, then verify.")},
    Row{ErrorCode::target_partly_covered,
        QT_TRANSLATE_NOOP("errors",
                          "The target before camera {view} is partly occluded: {percent} % of it is measured."),
        QT_TRANSLATE_NOOP("errors", "The numbers hold, with their uncertainty; wipe the target at the next stop.")},
    Row{ErrorCode::reference_lost, QT_TRANSLATE_NOOP("errors", "A reference mark is not seen: {reason}."),
        QT_TRANSLATE_NOOP(
            "errors",
            "The measurement goes on with the other mark and a larger uncertainty; wipe the mark, or take "
            "away what covers it.")},
    Row{ErrorCode::sensor_dead, QT_TRANSLATE_NOOP("errors", "The temperature sensor {sensor} gives no value."),
        QT_TRANSLATE_NOOP("errors", "Check its plug and cable, or leave it out of the model.")},
    Row{ErrorCode::sensor_stuck,
        QT_TRANSLATE_NOOP("errors", "The temperature sensor {sensor} has not moved for {seconds} s: it is stuck."),
        QT_TRANSLATE_NOOP("errors", "Check it, or leave it out of the model.")},
    Row{ErrorCode::sensor_spiking,
        QT_TRANSLATE_NOOP("errors", "The temperature sensor {sensor} shows spikes ({count} lately)."),
        QT_TRANSLATE_NOOP("errors", "Check its plug and the shield of its cable; the spikes are left out of the fit.")},
    Row{ErrorCode::sensor_jumped,
        QT_TRANSLATE_NOOP("errors",
                          "The temperature sensor {sensor} jumped by {kelvin} K from one reading to the next."),
        QT_TRANSLATE_NOOP("errors",
                          "Check whether it came loose or was plugged in elsewhere, or leave it out of the model.")},
    Row{ErrorCode::sensor_swapped,
        QT_TRANSLATE_NOOP("errors", "The temperature sensors {sensor} and {other} have changed places."),
        QT_TRANSLATE_NOOP("errors", "Plug them back; what was recorded since belongs to the other one.")},
    Row{ErrorCode::interlock_compensation_on,
        QT_TRANSLATE_NOOP("errors", "Not allowed while the compensation is ON: {operation}."),
        QT_TRANSLATE_NOOP("errors", "Switch the compensation off first; data measured with it on would be wrong.")},
    Row{ErrorCode::interlock_compensation_off,
        QT_TRANSLATE_NOOP("errors", "Not allowed while the compensation is OFF: {operation}."),
        QT_TRANSLATE_NOOP("errors", "Switch the compensation on first.")},
    Row{ErrorCode::limit_exceeded, QT_TRANSLATE_NOOP("errors", "{what} is {found}, beyond the limit of {limit}."),
        QT_TRANSLATE_NOOP("errors", "Nothing was written; check the model or the limit.")},
    Row{ErrorCode::not_confirmed, QT_TRANSLATE_NOOP("errors", "{operation} was not confirmed; nothing was written."),
        QT_TRANSLATE_NOOP("errors", "Confirm it, or use --yes.")},
    Row{ErrorCode::access_locked,
        QT_TRANSLATE_NOOP("errors",
                          "{operation} needs the engineer: this computer is locked and may only read from machines."),
        QT_TRANSLATE_NOOP("errors",
                          "Unlock it with the engineer's PIN (the lock at the bottom of the window, or --pin-file).")},
    Row{ErrorCode::access_wrong_pin, QT_TRANSLATE_NOOP("errors", "The PIN is not right."),
        QT_TRANSLATE_NOOP("errors", "Try again; it is the one that was set on this computer.")},
    Row{ErrorCode::access_wait, QT_TRANSLATE_NOOP("errors", "Too many wrong PINs: the next try counts in {seconds} s."),
        QT_TRANSLATE_NOOP("errors", "Wait, then try again.")},
    Row{ErrorCode::access_bad_pin, QT_TRANSLATE_NOOP("errors", "The PIN must have {least} to {most} characters."),
        QT_TRANSLATE_NOOP("errors", "Choose another one.")},
    Row{ErrorCode::job_reaches_out,
        QT_TRANSLATE_NOOP("errors", "The job names a file of another computer: {key} is \"{found}\". It was not read."),
        QT_TRANSLATE_NOOP("errors", "Load the machine's connection profile again; the job then holds what it needs.")},
    Row{ErrorCode::upload_read_back,
        QT_TRANSLATE_NOOP("errors", "Register {register} reads back {read} instead of {written}."),
        QT_TRANSLATE_NOOP("errors", "Nothing was activated; check the link and the register map.")},
    Row{ErrorCode::upload_rejected, QT_TRANSLATE_NOOP("errors", "The controller rejected the table: {reason}."),
        QT_TRANSLATE_NOOP("errors", "Nothing was activated; the old table is active.")},
    Row{ErrorCode::upload_restored,
        QT_TRANSLATE_NOOP("errors", "The upload failed ({reason}); the old table was restored and read back."),
        QT_TRANSLATE_NOOP("errors", "Find the cause, then upload again.")},
    Row{ErrorCode::upload_restore_failed,
        QT_TRANSLATE_NOOP("errors",
                          "The upload failed ({reason}) AND the old table could not be restored ({detail}). The "
                          "machine's table is not "
                          "known."),
        QT_TRANSLATE_NOOP("errors",
                          "Do not machine parts. Switch the compensation off at the controller, then use rollback.")},
    Row{ErrorCode::upload_left_off,
        QT_TRANSLATE_NOOP(
            "errors",
            "The upload failed ({reason}). The old table is still active, but the compensation switch could "
            "not be turned on again ({detail})."),
        QT_TRANSLATE_NOOP(
            "errors",
            "The machine runs without compensation until the switch is turned on: do it at the controller, or "
            "here when the controller answers again.")},
    Row{ErrorCode::compensation_ended,
        QT_TRANSLATE_NOOP(
            "errors",
            "The compensation ended: {reason}. The offset is back at 0; the compensation switch is {switch}."),
        QT_TRANSLATE_NOOP("errors", "Find the cause, then start it again.")},
    Row{ErrorCode::compensation_left,
        QT_TRANSLATE_NOOP(
            "errors",
            "The compensation ended ({reason}), but the machine could NOT be left as it was found ({detail}). "
            "The controller holds this offset: {held}; the compensation switch is {switch}."),
        QT_TRANSLATE_NOOP(
            "errors",
            "Do not machine parts. Look at the offset at the controller and switch its compensation off; a "
            "watchdog in the controller takes the offset out by itself.")},
    Row{ErrorCode::sign_check_failed,
        QT_TRANSLATE_NOOP("errors",
                          "The sign check failed on axis {axis}: commanded {commanded_um} um, seen in um: {seen_um}."),
        QT_TRANSLATE_NOOP("errors", "Nothing was written; check the axis direction and the calibration.")},
};

constexpr std::array<std::pair<const char*, const char*>, 19> steps = {{
    {"machine", QT_TRANSLATE_NOOP("steps", "machine")},
    {"calibrate", QT_TRANSLATE_NOOP("steps", "calibrate")},
    {"calibration", QT_TRANSLATE_NOOP("steps", "calibration")},
    {"warmup", QT_TRANSLATE_NOOP("steps", "warm-up")},
    {"sensors", QT_TRANSLATE_NOOP("steps", "sensors")},
    {"fit", QT_TRANSLATE_NOOP("steps", "fit")},
    {"model", QT_TRANSLATE_NOOP("steps", "model")},
    {"physics", QT_TRANSLATE_NOOP("steps", "physics")},
    {"upload", QT_TRANSLATE_NOOP("steps", "upload")},
    {"verify", QT_TRANSLATE_NOOP("steps", "verify")},
    {"verification", QT_TRANSLATE_NOOP("steps", "verification")},
    {"report", QT_TRANSLATE_NOOP("steps", "report")},
    {"axis_errors", QT_TRANSLATE_NOOP("steps", "axis errors")},
    {"axis_table", QT_TRANSLATE_NOOP("steps", "axis table")},
    {"correction", QT_TRANSLATE_NOOP("steps", "correction")},
    {"job", QT_TRANSLATE_NOOP("steps", "job")},
    {"describe", QT_TRANSLATE_NOOP("steps", "description")},
    {"description", QT_TRANSLATE_NOOP("steps", "description")},
    {"recordings", QT_TRANSLATE_NOOP("steps", "recordings")},
}};

QString factInWords(const std::string& key, const std::string& value) {
  if (key != "step" && key != "needs") return coreText(value);
  QStringList names;
  for (const QString& id : QString::fromStdString(value).split(QStringLiteral(", "))) {
    const QString name = stepName(id.toStdString());
    names << (name == id ? coreText(id) : name);
  }
  return names.join(QCoreApplication::translate("steps", ", ", "between the names of steps"));
}

/// Puts the context into the braces; a fact that is not known shows as a dash.
constexpr qsizetype longest_fact = 600;
constexpr QStringView stops = u".\u3002";
constexpr QStringView ends = u".?!\u3002\uff1f\uff01";

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
    const QString words = fact == error.context.end() ? QStringLiteral("-") : factInWords(fact->first, fact->second);
    // A cell of a file from elsewhere may be megabytes long.
    out += words.size() <= longest_fact ? words : words.left(longest_fact) + QStringLiteral("...");
    i = end;
    // A fact that ends a sentence by itself needs no second stop.
    const bool stop_follows = i + 1 < source.size() && stops.contains(source[i + 1]);
    if (stop_follows && !out.isEmpty() && ends.contains(out.back())) ++i;
  }
  return out;
}

}  // namespace

QString stepName(const std::string& id) {
  for (const auto& [known, name] : steps) {
    if (id == known) return QCoreApplication::translate("steps", name);
  }
  return QString::fromStdString(id);
}

ErrorText textOf(const Error& error, Reader reader) {
  for (const Row& row : rows) {
    if (row.code != error.code) continue;
    const char* remedy = reader == Reader::window ? window_remedy(error.code) : nullptr;
    return {filled(row.sentence, error), filled(remedy == nullptr ? row.remedy : remedy, error)};
  }
  return {QString::fromStdString(describe(error)), {}};
}

QString lineOf(const Error& error, Reader reader) {
  const ErrorText text = textOf(error, reader);
  return text.remedy.isEmpty() ? text.sentence : text.sentence + QStringLiteral(" ") + text.remedy;
}

}  // namespace zerodrift
