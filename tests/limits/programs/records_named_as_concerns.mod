MODULE records_named_as_concerns
  ! Types may have any name; what the interpreter calls its own things is none of theirs.
  RECORD motion
    num x;
  ENDRECORD
  RECORD skip
    num x;
  ENDRECORD
  RECORD len
    num x;
  ENDRECORD
  RECORD controller
    num x;
  ENDRECORD
  VAR motion way:=[1];
  VAR skip left:=[2];
  VAR len size:=[3];
  VAR controller unit:=[4];
  VAR tasks others{2}:=[["T_ROB1"],["T_ROB2"]];
  VAR robtarget here;
  VAR num list{3}:=[1,2,3];

  PROC main()
    others{1}.taskname:=others{2}.taskname+"x";
    way.x:=way.x+MotionPlannerNo();
    left.x:=left.x+1;
    size.x:=Dim(list,1)+StrLen("ab");
    here:=CRobT(\Tool:=tool0 \WObj:=wobj0);
    FOR i FROM 1 TO unit.x DO
      MoveAbsJ [[0,0,0,0,30,i],[9E9,9E9,9E9,9E9,9E9,9E9]],v100,fine,tool0;
    ENDFOR
    TPWrite others{1}.taskname\Num:=way.x+left.x+size.x;
  ENDPROC
ENDMODULE
