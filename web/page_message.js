// The page's message line.
export const at = (id) => document.getElementById(id);

const message = at('message');

export function say(text, className = '') {
  message.textContent = text;
  message.className = className;
}

export function complain(error) {
  say(error.message, 'error');
}

const isError = () => message.className === 'error';

/** Says how far something has got, unless an error is to be read. */
export function tell(text) {
  if (!isError()) say(text);
}

/** Removes the message if it is an error; given a text, only if it is that error. */
export function dismiss(text = message.textContent) {
  if (isError() && message.textContent === text) say('');
}

/** Removes the message unless it is an error, and shows `error` instead, if there is one. */
export function hush(error) {
  if (!isError()) say(error, error && 'error');
}
