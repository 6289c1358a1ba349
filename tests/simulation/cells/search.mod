MODULE search
  ! diTouch goes to 1 after 2 s for 2 s: the first search finds it and stops, the second finds the
  ! falling flank and goes on to its end, the third finds nothing, the fourth finds it there already.
  ! At 100 mm/s the first has come 104 mm from y = -200 in the 1.09 s it had, less 0.05 s for its
  ! ramp; it brakes on 5 mm. The second leaves y = -91 at once and has 1.91 s, also less 0.05 s.
  CONST robtarget a:=[[800,-200,600],[0,0,1,0],[-1,0,-1,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST robtarget b:=[[800,300,600],[0,0,1,0],[0,0,0,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR robtarget found;
  VAR pos here;
  PROC main()
    MoveJ a,v500,fine,tool0;
    SearchL \Stop,diTouch,found,b,v100,tool0;
    TPWrite "found at y = -96: "\Bool:=Abs(found.trans.y+96)<4;
    here:=CPos();
    TPWrite "stands 2 to 8 mm on: "\Bool:=here.y-found.trans.y>2 AND here.y-found.trans.y<8;
    SearchL diTouch \NegFlank,found,b,v100,tool0;
    TPWrite "found at y = 95: "\Bool:=Abs(found.trans.y-95)<4;
    TPWrite "stands at the end: "\Bool:=Distance(CPos(),b.trans)<0.001;
    SearchL diTouch,found,a,v100,tool0;
    Set doTouch;
    SearchL diTouch,found,b,v100,tool0;
  ERROR
    IF ERRNO=ERR_WHLSEARCH TPWrite "nothing found";
    IF ERRNO=ERR_SIGSUPSEARCH TPWrite "there already";
    TRYNEXT;
  ENDPROC
ENDMODULE
