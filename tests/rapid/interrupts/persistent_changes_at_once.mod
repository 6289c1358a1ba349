! RAPID Instructions, IPers: changes one after the other each run the trap, before the next statement.
MODULE persistent_changes_at_once
  PERS num parts:=0;
  PERS pos place:=[0,0,0];
  VAR intnum counted;
  VAR intnum once;
  VAR intnum moved;
  VAR num changes;
  VAR num first;

  PROC main()
    CONNECT counted WITH on_count;
    CONNECT once WITH on_first;
    CONNECT moved WITH on_move;
    IPers parts,counted;
    IPers\Single,parts,once;
    IPers place,moved;
    parts:=1;
    TPWrite "changes "\Num:=changes;    ! -> changes 1
    parts:=1;
    parts:=2;
    Incr parts;
    place.x:=5;
    fill parts;
    FOR i FROM 1 TO 3 DO
      parts:=parts+i;
    ENDFOR
    TPWrite "changes "\Num:=changes;    ! -> changes 8
    TPWrite "first "\Num:=first;        ! -> first 1
  ENDPROC

  PROC fill(INOUT num level)
    level:=50;
    level:=100;
  ENDPROC

  TRAP on_count
    Incr changes;
  ENDTRAP

  TRAP on_first
    first:=parts;
  ENDTRAP

  TRAP on_move
    TPWrite "at "\Pos:=place;           ! -> at [5,0,0]
  ENDTRAP
ENDMODULE
