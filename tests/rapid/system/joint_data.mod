! RAPID Instructions, GetJointData: where an axis is and how fast it turns.
MODULE joint_data
  CONST jointtarget home:=[[0,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  CONST jointtarget aside:=[[60,0,0,0,30,0],[9E9,9E9,9E9,9E9,9E9,9E9]];
  VAR intnum underway;
  VAR num angle;
  VAR num speed;

  PROC main()
    MoveAbsJ home,v500,fine,tool0;
    GetJointData 5\Position:=angle\Speed:=speed;
    TPWrite ValToStr(Round(angle))+" "+ValToStr(speed); ! -> 30 0
    CONNECT underway WITH look;
    ITimer\Single,0.4,underway;
    MoveAbsJ aside,v500,fine,tool0;
    GetJointData\MechUnit:=ROB_ID,1\Position:=angle;
    TPWrite ValToStr(Round(angle));         ! -> 60
    GetJointData 7\Position:=angle;
    TPWrite "behind";                       ! -> behind
  ERROR
    TPWrite ValToStr(ERRNO=ERR_AXIS_PAR);   ! -> TRUE
    TRYNEXT;
  ENDPROC

  TRAP look
    GetJointData 1\Position:=angle\Speed:=speed;
    TPWrite ValToStr(speed>5 AND angle>0 AND angle<60); ! -> TRUE
  ENDTRAP
ENDMODULE
