// SPDX-License-Identifier: MIT
// One palette for each scheme, after Okabe and Ito (2008): told apart by those who see no red or
// green, and by brightness in print.

export interface Colors {
  name: "light" | "dark";
  outside: string;
  floor: string;
  wall: string;
  lines: string;
  road: string;
  vertex: string;
  arrow: string;
  text: string;
  faint: string;
  doing: string[]; // by Doing
  onRobot: string; // text on robots that move or collide
  onPale: string; // and on all others, which are brighter
  heading: string;
  collision: string;
  chosen: string;
  goal: string;
  task: string;
  taskOpen: string;
  taskBegun: string;
  taskDone: string;
  onTask: string;
  heat: string;
}

export const kLight: Colors = {
  name: "light",
  outside: "#e8eaed",
  floor: "#ffffff",
  wall: "#5f6670",
  lines: "#eceef1",
  road: "#cfd5dc",
  vertex: "#8b949e",
  arrow: "#6b7480",
  text: "#1c2128",
  faint: "#656d76",
  doing: ["#0072b2", "#e69f00", "#009e73", "#8a929c"],
  onRobot: "#ffffff",
  onPale: "#1c2128",
  heading: "#1c2128",
  collision: "#d0021b",
  chosen: "#b4009e",
  goal: "#8a929c",
  task: "#7a5c00",
  taskOpen: "#fff3c4",
  taskBegun: "#f0e442",
  taskDone: "#d7dbe0",
  onTask: "#1c2128",
  heat: "#d55e00",
};

export const kDark: Colors = {
  name: "dark",
  outside: "#0b0e13",
  floor: "#1b2028",
  wall: "#454c57",
  lines: "#242a33",
  road: "#3a424d",
  vertex: "#7d8590",
  arrow: "#98a2ae",
  text: "#e6eaef",
  faint: "#8b949e",
  doing: ["#56b4e9", "#e69f00", "#2fc79a", "#7d8590"],
  onRobot: "#0b0e13",
  onPale: "#0b0e13",
  heading: "#ffffff",
  collision: "#ff5c5c",
  chosen: "#ff7ad9",
  goal: "#7d8590",
  task: "#d9b64a",
  taskOpen: "#4a4020",
  taskBegun: "#b8ac2e",
  taskDone: "#2f353e",
  onTask: "#ffffff",
  heat: "#ff8c42",
};
