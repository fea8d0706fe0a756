// The catalogue: names of sensors and plans that the program itself brings along.

#include "core/report/text/language.h"

namespace zerodrift::report {

std::vector<TextEntry> texts_of_machine() {
  return {
      {"Spindle front bearing", "主轴前轴承"},
      {"Spindle rear bearing", "主轴后轴承"},
      {"Spindle between front bearing and motor", "主轴前轴承与电机之间"},
      {"Spindle motor, front end", "主轴电机前端"},
      {"Spindle motor, rear end", "主轴电机后端"},
      {"Spindle nose", "主轴端"},
      {"Headstock", "主轴箱"},
      {"Column front, top", "立柱前侧上部"},
      {"Column rear, top", "立柱后侧上部"},
      {"Column", "立柱"},
      {"Bed", "床身"},
      {"Table", "工作台"},
      {"Coolant tank", "冷却液箱"},
      {"X guide", "X 轴导轨"},
      {"X screw nut", "X 轴丝杠螺母"},
      {"X screw support bearing", "X 轴丝杠支承轴承"},
      {"Y screw nut", "Y 轴丝杠螺母"},
      {"Y screw support bearing", "Y 轴丝杠支承轴承"},
      {"Z screw nut", "Z 轴丝杠螺母"},
      {"Z screw support bearing", "Z 轴丝杠支承轴承"},
      {"A trunnion drive", "A 轴摇篮驱动"},
      {"front", "前方"},
      {"side", "侧方"},
      {"C table drive", "C 轴转台驱动"},
      {"Warm-up, 4 h, stepped speeds", "暖机 4 h，阶梯转速"},
      {"Warm-up, 4 h at 3000 rpm", "暖机 4 h，3000 rpm"},
      {"Warm-up and cooling, 3000 rpm", "暖机与冷却，3000 rpm"},
      {"Stepped speed spectrum", "阶梯转速谱"},
      {"ISO 230-3 environment (ETVE), 24 h", "ISO 230-3 环境（ETVE），24 h"},
      {"ISO 230-3 spindle, constant speed", "ISO 230-3 主轴，恒定转速"},
      {"ISO 230-3 spindle, varying speed", "ISO 230-3 主轴，变化转速"},
      {"ISO 230-3 linear axes", "ISO 230-3 线性轴"},
      {"Short check, 30 min at 3000 rpm", "快速检查，3000 rpm 30 min"},
      {"r is blind to scale: it says nothing about um; the largest residual is {} um at {} mm",
       "r 与比例无关：不反映 um 大小；最大残差为 {} um，位于 {} mm 处"},
      {"criterion: the fewest segments that stay within {} um at every point; the largest residual is {} um",
       "判据：在每一点都不超过 {} um 的最少分段；最大残差为 {} um"},
      {"criterion: |r| of position and measured position at least {}; with laser data it is always about 1, so it can "
       "never drop a point: use errors or a tolerance",
       "判据：位置与实测位置的 |r| 至少 {}；对激光数据该值总约为 1，不会舍弃任何点：请改用误差或公差"},
      {"criterion: |r| of position and error at least {}, from {} points",
       "判据：位置与误差的 |r| 至少 {}，起始 {} 点"},
  };
}

}  // namespace zerodrift::report
