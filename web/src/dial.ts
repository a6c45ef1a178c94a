import { html, svg, type TemplateResult } from 'lit';
import { number, t } from './messages';
import type { Station } from './types';

const arc = (from: number, to: number, inner: number, outer: number): string => {
  const at = (angle: number, radius: number) =>
    `${(100 + radius * Math.sin(angle)).toFixed(2)} ${(100 - radius * Math.cos(angle)).toFixed(2)}`;
  const large = to - from > Math.PI ? 1 : 0;
  return `M${at(from, outer)}A${outer} ${outer} 0 ${large} 1 ${at(to, outer)}L${at(to, inner)}A${inner} ${inner} 0 ${large} 0 ${at(from, inner)}Z`;
};

/** The turntable seen from above: one segment a station, which fills when its view is measured. */
export function dial(stations: Station[], progress: number, note: string): TemplateResult {
  const count = Math.max(1, stations.length);
  const turn = (2 * Math.PI) / count;
  const gap = Math.min(0.045, turn / 8);
  const done = stations.filter((s) => s.state === 'done').length;
  const label = t('scan.stations', { done, count: stations.length });
  return html`<svg class="dial" viewBox="0 0 200 200" role="img" aria-label=${label}>
    <circle class="dial-rim" cx="100" cy="100" r="97" />
    ${Array.from({ length: 72 }, (_, i) => {
      const angle = (i * 5 * Math.PI) / 180;
      const inner = i % 9 === 0 ? 90.5 : 93.5;
      return svg`<line class="dial-tick" x1=${100 + inner * Math.sin(angle)} y1=${100 - inner * Math.cos(angle)}
        x2=${100 + 97 * Math.sin(angle)} y2=${100 - 97 * Math.cos(angle)} />`;
    })}
    ${stations.map((station, i) => {
      const from = i * turn + gap / 2;
      const quality = station.state === 'done' && station.verdict && !station.good ? 'poor' : station.state;
      return svg`<path class="dial-station ${quality}" d=${arc(from, from + turn - gap, 66, 86)}>
        <title>${number(station.angle_deg, 1)}°  ${station.verdict}</title></path>`;
    })}
    <path
      class="dial-progress"
      d=${progress > 0.002 ? arc(0, Math.min(progress, 0.9999) * 2 * Math.PI, 59.5, 61) : ''}
    />
    <text class="dial-count" x="100" y="104">
      ${done}
      <tspan class="dial-of">/ ${stations.length}</tspan>
    </text>
    <text class="dial-note" x="100" y="122">${note}</text>
  </svg>`;
}
