// Paths of Windows as the module sees them, where every path begins with a slash: /C:/faces/head.glb.
const isWindows = (platform) => platform === 'win32';

/** The path of a folder or file of this machine for the module. */
export const pathOf = (path, platform = process.platform) =>
  isWindows(platform) ? '/' + path.replaceAll('\\', '/') : path;

/** One of the module's absolute paths on this machine. */
export const place = (path, platform = process.platform) =>
  isWindows(platform) && /^\/[A-Za-z]:/.test(path) ? path.slice(1).replace(/^(..)$/, '$1/') : path;

/** A word of the command line for the module. */
export function wordOf(word, platform = process.platform) {
  if (!isWindows(platform)) return word;
  return /^[A-Za-z]:[\\/]/.test(word) ? pathOf(word, platform) : word.replaceAll('\\', '/');
}

/** The folder that relative paths start from; none if it was removed. */
export function currentFolder() {
  try {
    return pathOf(process.cwd());
  } catch {
    return '/';
  }
}
