// Reads timelines, which animators write, and plays them on a face.
import {faultOf, goesBy, KINDS, NUMBERS} from './sweepface_drives.js';
import {matchNames, turnsEyes} from './sweepface_names.js';
import {isObject, parseJson, textOf} from './sweepface_text.js';
import {checkTime, isWeight, known, passed} from './sweepface_values.js';

const EVENT = ['at', 'to', 'only', 'drive', 'region', ...NUMBERS];
const TIMELINE = ['seconds', 'loops', 'poses', 'events', 'regions'];
const MOST_GOALS = 8e6;

/** Reads a timeline from JSON text or bytes: {seconds, loops, events, regions}; `regions` are for Sweepface.load. */
export function readTimeline(source, options) {
  const {name: given} = known(options, ['name'], 'readTimeline');
  const name = given || 'The timeline', json = parseJson(textOf(source, 'timeline', name), name);
  const fail = (place, what) => new Error(`${name}: ${place} ${what}.`);
  if (!isObject(json)) throw fail('the file', 'is not an object');
  for (const key of Object.keys(json))
    if (!TIMELINE.includes(key)) throw fail('the file', `has an unknown key '${key}'`);
  const {seconds, loops = 1, poses = {}, events, regions} = json, sizes = new Map();
  if (seconds === undefined) throw fail('the file', 'has no \'seconds\'');
  for (const key of ['seconds', 'loops'])
    if (key in json && !Number.isFinite(json[key])) throw fail('the file', `has a '${key}' that is not a number`);
  if (!(seconds > 0)) throw fail('\'seconds\'', 'must be greater than 0');
  if (!Number.isInteger(loops) || loops < 1 || loops > 10000)
    throw fail('\'loops\'', 'must be a whole number from 1 to 10000');
  if (!Array.isArray(events) || events.length === 0) throw fail('\'events\'', 'must be a list of at least one event');
  if (regions !== undefined && !Array.isArray(regions)) throw fail('\'regions\'', 'are not a list');
  if (!isObject(poses)) throw fail('\'poses\'', 'are not an object');
  for (const [pose, weights] of Object.entries(poses)) {
    if (!isObject(weights)) throw fail(`pose '${pose}'`, 'is not an object of weights');
    sizes.set(weights, countOf(weights, `pose '${pose}'`, fail));
  }
  const end = seconds * loops * (1 + 1e-9);  // 0.1 + 0.2 is more than 0.3
  let goals = 0;
  const read = events.map((json, k) => {
    const place = `events[${k}]`, event = readEvent(json, {poses, sizes}, place, fail);
    goals += sizes.get(event.goals);
    if (goals > MOST_GOALS)
      throw fail(place, 'is beyond the 8,000,000 goals of a timeline, those of poses counted for each event; send off ' +
                        'fewer weights, or cut it');
    if (event.at > seconds) throw fail(place, 'is later than \'seconds\'');
    if (event.at + (event.drive.delay ?? 0) > end)
      throw fail(place, 'has a \'delay\' that leads beyond the end, so that it never plays');
    return event;
  });
  return {seconds, loops, events: read, regions};
}

function readEvent(event, file, place, failAt) {
  const fail = (what) => failAt(place, what);
  if (!isObject(event)) throw fail('is not an object');
  for (const key of Object.keys(event))
    if (!EVENT.includes(key)) throw fail(`has an unknown key '${key}'`);
  if (!('at' in event)) throw fail('has no \'at\'');
  for (const key of ['at', ...NUMBERS])
    if (key in event && !Number.isFinite(event[key])) throw fail(`has a '${key}' that is not a number`);
  for (const key of ['drive', 'region'])
    if (key in event && typeof event[key] !== 'string') throw fail(`has a '${key}' that is not a text`);
  const {drive: kind = 'spring'} = event, numbers = NUMBERS.filter((key) => key in event);
  if (!KINDS.includes(kind))
    throw failAt(`${place}:`, `There is no way to move called "${kind}"; there are ${KINDS.join(', ')}`);
  const idle = numbers.find((key) => !goesBy(kind, key));
  if (idle)
    throw fail(`has a '${idle}', which the drive '${kind}' has no use for; leave it out, or name another drive`);
  if (event.at < 0) throw fail('is before 0');
  const fault = faultOf({...event, kind});
  if (fault) throw fail(`cannot be: ${fault}`);
  if (event.delay < 0) throw fail('has a negative \'delay\'');
  if (('to' in event) === ('only' in event)) throw fail('needs one of \'to\' and \'only\', the weights to go to');
  const goals = readGoals(event.to ?? event.only, file, place, failAt), drive = {kind};
  for (const key of numbers) drive[key] = event[key];
  return {at: event.at, goals, others: 'only' in event, drive, region: event.region || undefined};
}

/**
 * The goals of an event: weights by name, given directly or by the name of a pose that has them. Adds their number to
 * `sizes`, which has those of the poses.
 */
function readGoals(wanted, {poses, sizes}, place, failAt) {
  if (typeof wanted === 'string') {
    if (!Object.prototype.hasOwnProperty.call(poses, wanted))
      throw failAt(place, `goes to a pose '${wanted}' that 'poses' does not have`);
    return poses[wanted];
  }
  if (!isObject(wanted)) throw failAt(place, 'goes neither to weights nor to a pose');
  sizes.set(wanted, countOf(wanted, place, failAt));
  return wanted;
}

/** How many weights there are, all of them sound. */
function countOf(weights, place, failAt) {
  const goals = Object.entries(weights);
  for (const [weight, goal] of goals)
    if (!isWeight(goal)) throw failAt(place, `has a weight '${weight}' that is not a number within ±1,000,000`);
  return goals.length;
}

/** Whether a region is all of a face that is not divided. */
const isWhole = (face, region) => region === 'rest' && !face.regions?.length;

/** Plays a timeline on a face: `advance` lets time pass, and every event sets out at its exact time. */
export class TimelinePlayer {
  #events;  // sorted by time
  #goals;
  #looks;  // whether its weights say where the eyes look
  #now = 0;
  #next = 0;  // index among all events of all loops

  constructor(face, timeline) {
    if (typeof face?.moveTo !== 'function' || !Array.isArray(timeline?.events))
      throw new TypeError('A TimelinePlayer plays a timeline on a face; give it the face, and what readTimeline returns.');
    for (const {region} of timeline.events)
      if (region && face.regions?.includes(region) === false && !isWhole(face, region))
        throw new Error(`The timeline moves a region '${region}'; the face has ${face.regions.join(', ') || 'none'}.`);
    this.face = face;
    this.timeline = timeline;
    this.#events = [...timeline.events].sort((a, b) => a.at - b.at);
    const goals = new Set(timeline.events.map((event) => event.goals));  // many events may go to one pose
    const names = [...new Set([...goals].flatMap(Object.keys))];
    /** Which names drive which targets: see matchNames. */
    this.match = matchNames(names, face.names);
    this.#looks = turnsEyes(this.match, face.names);
    this.#goals = new Map(names.map((name, k) => [name, this.match.targets[k].map((target) => face.names[target])]));
  }

  get seconds() { return this.timeline.seconds * this.timeline.loops; }

  /** Starts again from the beginning; the face goes on from where it stands, as it does from loop to loop. */
  restart() { this.#now = this.#next = 0; }

  /** Lets time pass; returns whether anything is still to come or moves. */
  advance(seconds) {
    checkTime(seconds);
    const {seconds: length, loops} = this.timeline, events = this.#events, until = this.#now + passed(seconds);
    let moves = false;
    while (this.#next < loops * events.length) {
      const event = events[this.#next % events.length], loop = Math.floor(this.#next / events.length);
      const start = event.at + loop * length;
      if (start > until) break;
      this.face.advance(start - this.#now);
      this.#now = start;
      ++this.#next;  // even if the face refuses it
      this.#play(event);
      moves = true;
    }
    moves = this.face.advance(until - this.#now) || moves;
    this.#now = until;
    return moves || this.#now < this.seconds;
  }

  #play({goals, others, drive, region}) {
    const all = others ? Object.fromEntries([...this.#goals.values()].flat().map((target) => [target, 0])) : {};
    const named = Object.create(null);  // of two names for one target the larger counts
    for (const [name, goal] of Object.entries(goals))
      for (const target of this.#goals.get(name)) named[target] = Math.max(named[target] ?? -Infinity, goal);
    // Angles of a clip may still hold the eyes, so that weights would not count.
    if (this.#looks && this.face.eyeCount > 0) this.face.look(null);
    this.face.moveTo({...all, ...named}, drive, isWhole(this.face, region) ? undefined : region);
  }
}
