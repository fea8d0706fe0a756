#pragma once
// Files as loggers and spreadsheets write them, all of one run: two temperatures and a probe, a row each 20 s.
// Made here, in the forms that their makers document.

#include <fmt/format.h>

#include <string>
#include <vector>

namespace zerodrift::logger_files {

struct Row {
  double time_s;
  double front_C;
  double column_C;
  double probe_um;
  bool coolant;
};

inline std::vector<Row> run(int rows = 30) {
  std::vector<Row> out;
  for (int k = 0; k < rows; ++k) {
    out.push_back({20.0 * k, 20.0 + 0.05 * k, 19.5 + 0.01 * k, -0.25 + 0.5 * k, k % 10 >= 5});
  }
  return out;
}

/// 07:12:40 and so many seconds later.
inline std::string clock(double time_s, const char* form = "{:02}:{:02}:{:02}") {
  const int s = 7 * 3600 + 12 * 60 + 40 + static_cast<int>(time_s);
  return fmt::format(fmt::runtime(form), s / 3600, s / 60 % 60, s % 60);
}

inline std::string contract() {
  std::string out = "time_s,T1_C,T2_C,dZ_um,coolant_on\n";
  for (const Row& r : run()) {
    out += fmt::format("{},{:.2f},{:.2f},{:.2f},{}\n", r.time_s, r.front_C, r.column_C, r.probe_um, int(r.coolant));
  }
  return out;
}

inline std::string graphtec() {
  std::string out =
      "Vendor, GRAPHTEC Corporation\r\nModel, GL840\r\nSampling interval, 20s\r\nStart time, 2025/11/03, 07:12:40\r\n"
      "AMP settings\r\nCH, Signal name, Input, Range, Filter, Span\r\nCH1, FRONT, TEMP, TC_K, Off, 200, -20, degC\r\n"
      "CH2, COLUMN, TEMP, TC_K, Off, 200, -20, degC\r\nCH3, PROBE Z, DC, 20V, Off, 500, -500, um\r\nData\r\n"
      "Number, Date&Time, ms, CH1, CH2, CH3, Alarm1\r\nNO., Time, ms, degC, degC, um, A1234567890\r\n";
  int number = 0;
  for (const Row& r : run()) {
    ++number;
    out += fmt::format("{}, 2025/11/03 {}, 0, {:+.2f}, {}, {:+.2f}, LLLLLLLLLL\r\n", number, clock(r.time_s), r.front_C,
                       number == 7 ? "BURNOUT" : fmt::format("{:+.2f}", r.column_C), r.probe_um);
  }
  return out;
}

inline std::string benchlink() {
  std::string out =
      "Name:,run,,,,,,,,\r\nAcquisition Date:,23/11/2025 07:12:40,,,,,,,,\r\nInstrument:,34972A,Address:,USB,,,,,,\r\n"
      "Channel,Name,Function,Range,Resolution,Advanced Settings,Scale,Gain,Offset,Label\r\n"
      "101,front,Temp (Type K),C,,,,,,\r\n102,column,Temp (Type K),C,,,,,,\r\n"
      "103,probe,DC volts,Auto,5.5,,True,100,0,um\r\nScan Control:,Interval 00:00:20:000,,,,,,,,\r\n"
      "Scan,Time,101 (C),Alarm 101,102 (C),Alarm 102,103 (um),Alarm 103,,\r\n";
  int scan = 0;
  for (const Row& r : run()) {
    ++scan;
    out += fmt::format("{},23/11/2025 {}:442,{:.3f},0,{},0,{:.3f},0,,\r\n", scan, clock(r.time_s), r.front_C,
                       scan < 3 ? "9.90000000E+37" : fmt::format("{:.3f}", r.column_C), r.probe_um);
  }
  return out;
}

inline std::string hobo() {
  std::string out =
      "\"Plot Title: spindle\"\r\n\"#\",\"Date Time, GMT+01:00\",\"Temp, \xC2\xB0"
      "C (LGR S/N: 1, SEN S/N: 1, LBL: front)\",\"Temp, \xC2\xB0"
      "C (LGR S/N: 1, SEN S/N: 2, LBL: column)\",\"Host Connected (LGR S/N: 1)\",\"End Of File (LGR S/N: 1)\"\r\n";
  int number = 0;
  for (const Row& r : run()) {
    out += fmt::format("{},11/23/25 {} AM,{:.3f},{:.3f},,\r\n", ++number, clock(r.time_s), r.front_C, r.column_C);
  }
  return out + "31,11/23/25 07:22:40 AM,,,Logged,Logged\r\n";
}

inline std::string labview(bool with_times = true) {
  std::string out =
      "LabVIEW Measurement\t\r\nWriter_Version\t2\r\nReader_Version\t2\r\nSeparator\tTab\r\nDecimal_Separator\t,\r\n"
      "Multi_Headings\tNo\r\nX_Columns\tOne\r\nTime_Pref\tRelative\r\nDate\t2025/11/03\r\nTime\t07:12:40,5\r\n"
      "***End_of_Header***\t\r\n\t\r\nChannels\t3\t\t\t\r\nSamples\t30\t30\t30\t\r\n"
      "Date\t2025/11/03\t2025/11/03\t2025/11/03\t\r\nTime\t07:12:40,5\t07:12:40,5\t07:12:40,5\t\r\n"
      "Y_Unit_Label\tDeg C\tDeg C\tum\t\r\nX_Dimension\tTime\tTime\tTime\t\r\nX0\t0,0E+0\t0,0E+0\t0,0E+0\t\r\n"
      "Delta_X\t20,000\t20,000\t20,000\t\r\n***End_of_Header***\t\t\t\t\r\nX_Value\tfront\tcolumn\tprobe\tComment\r\n";
  for (const Row& r : run()) {
    std::string line = fmt::format("{}\t{:.3f}\t{:.3f}\t{:.3f}\r\n", with_times ? fmt::format("{:.3f}", r.time_s) : "",
                                   r.front_C, r.column_C, r.probe_um);
    for (char& c : line) c = c == '.' ? ',' : c;
    out += line;
  }
  return out;
}

inline std::string picolog() {
  std::string out =
      ",front Ave. (\xC2\xB0"
      "C),column Ave. (\xC2\xB0"
      "C),probe Ave. (\xC2\xB5m)\r\n";
  for (const Row& r : run()) {
    out +=
        fmt::format("2025-11-03T{}+01:00,{:.3f},{:.3f},{:.3f}\r\n", clock(r.time_s), r.front_C, r.column_C, r.probe_um);
  }
  return out;
}

}  // namespace zerodrift::logger_files
