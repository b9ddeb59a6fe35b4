// A capture like those of Live Link Face, for tests: a minute at 60 Hz of every shape and angle.
import { writeFileSync } from 'node:fs';
import { inWork } from './tool.mjs';

const sides = (names) => names.flatMap((name) => [`${name}Left`, `${name}Right`]);
const shapes = [...sides(['EyeBlink', 'EyeLookDown', 'EyeLookIn', 'EyeLookOut', 'EyeLookUp', 'EyeSquint', 'EyeWide']),
                'JawForward', 'JawLeft', 'JawRight', 'JawOpen', 'MouthClose', 'MouthFunnel', 'MouthPucker', 'MouthLeft',
                'MouthRight', ...sides(['MouthSmile', 'MouthFrown', 'MouthDimple', 'MouthStretch']), 'MouthRollLower',
                'MouthRollUpper', 'MouthShrugLower', 'MouthShrugUpper',
                ...sides(['MouthPress', 'MouthLowerDown', 'MouthUpperUp', 'BrowDown']), 'BrowInnerUp',
                ...sides(['BrowOuterUp']), 'CheekPuff', ...sides(['CheekSquint', 'NoseSneer']), 'TongueOut'];
const angles = ['HeadYaw', 'HeadPitch', 'HeadRoll', 'LeftEyeYaw', 'LeftEyePitch', 'LeftEyeRoll', 'RightEyeYaw',
                'RightEyePitch', 'RightEyeRoll'];

/** The value of a column at a time, in seconds. */
export function recorded(column, seconds) {
  const k = [...shapes, ...angles].indexOf(column), swing = Math.sin((0.7 + 0.13 * k) * seconds + k);
  return angles.includes(column) ? 0.3 * swing : 0.4 + 0.4 * swing;
}

const two = (n) => String(n).padStart(2, '0');

/** The file's path. */
export function capture(name, seconds = 60) {
  const columns = [...shapes, ...angles], lines = [`Timecode,BlendShapeCount,${columns}`];
  for (let f = 0; f < 60 * seconds; ++f)
    lines.push(`11:${two(Math.floor(f / 3600))}:${two(Math.floor(f / 60) % 60)}:${two(f % 60)}.000,61,` +
               columns.map((column) => recorded(column, f / 60).toFixed(9)));
  const file = inWork(name);
  writeFileSync(file, `${lines.join('\n')}\n`);
  return file;
}
